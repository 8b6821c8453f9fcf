#pragma once

#include <string>

#include "fit/result.hpp"

namespace skinfit {

/// `value` with two digits of `sigma` behind it: 0.01234 and 0.00056 give "0.01234". Without a sigma, six digits.
[[nodiscard]] std::string rounded(double value, double sigma);

/// A Monte Carlo error in two digits; "none" for the angular solver, which draws no random numbers.
[[nodiscard]] std::string monte_carlo_words(double error);

/// One free parameter as the reports for people print it; "-" where there is nothing to print.
struct ParameterWords {
    std::string value;
    std::string sigma;
    std::string monte_carlo;
    std::string interval_95;  ///< "0.1 to 0.2"; one-sided, as "at most 0.2", where the value lies at a bound
    std::string unit;
    std::string remark;  ///< in capitals; empty where all is well
};

/// Which parameters their priors decide, as a sentence; empty where the spectrum decides all.
[[nodiscard]] std::string prior_words(const FitResult& result);

/// The words for one fitted parameter.
[[nodiscard]] ParameterWords parameter_words(const FittedParameter& free);

}  // namespace skinfit
