#include "fit/model_split.hpp"

#include <gtest/gtest.h>

#include "fit/report.hpp"

namespace skinfit::test {
namespace {

FittedParameter adjusted(Parameter parameter) {
    FittedParameter fitted{};
    fitted.parameter = parameter;
    fitted.name = info(parameter).name;
    fitted.uncertainty.status = Status::free;
    return fitted;
}

FitResult of_two(Parameter first, Parameter second, double correlation) {
    FitResult result;
    result.free = {adjusted(first), adjusted(second)};
    result.correlation = Eigen::MatrixXd::Identity(2, 2);
    result.correlation(0, 1) = result.correlation(1, 0) = correlation;
    result.spectra.resize(1);
    return result;
}

FitResult of_blood(double correlation) {
    return of_two(Parameter::papillary_blood_fraction, Parameter::reticular_blood_fraction, correlation);
}

TEST(ModelSplit, IsWhereTheSumIsKnownBetterThanTheParts) {
    EXPECT_TRUE(model_splits(of_blood(-0.49)).empty());
    EXPECT_TRUE(model_splits(of_blood(0.9)).empty()) << "of parts that rise together the ratio is known";
    const std::vector<ModelSplit> found = model_splits(of_blood(-0.5));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].use, "dermal_hemoglobin_umol_per_l");
    EXPECT_TRUE(is_split_by_model(found, "papillary_blood_fraction"));
    EXPECT_TRUE(is_split_by_model(found, "reticular_blood_fraction"));
    EXPECT_FALSE(is_split_by_model(found, "oxygen_saturation"));
}

TEST(ModelSplit, IsWhereThePriorOrNothingTellsOnePart) {
    for (const std::size_t part : {0U, 1U}) {
        FitResult result = of_two(Parameter::bilirubin_g_per_l, Parameter::dermal_bilirubin_g_per_l, 0.0);
        EXPECT_TRUE(model_splits(result).empty());
        result.free[part].uncertainty.decided_by_prior = true;
        ASSERT_EQ(model_splits(result).size(), 1U);
        EXPECT_EQ(model_splits(result)[0].use, "tissue_bilirubin_mg_per_dl");
        result.free[part].uncertainty.decided_by_prior = false;
        result.free[part].uncertainty.status = Status::not_identifiable;
        EXPECT_EQ(model_splits(result).size(), 1U);
    }
}

TEST(ModelSplit, IsNoneOfOnePartNorOfOwnParameters) {
    FitResult result = of_two(Parameter::papillary_blood_fraction, Parameter::oxygen_saturation, -0.9);
    result.free[0].uncertainty.decided_by_prior = true;
    EXPECT_TRUE(model_splits(result).empty());
    result = of_blood(-0.9);
    result.configuration.own[static_cast<std::size_t>(Parameter::papillary_blood_fraction)] = true;
    EXPECT_TRUE(model_splits(result).empty());
}

}  // namespace
}  // namespace skinfit::test
