#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/azimuth.hpp"
#include "model/fresnel.hpp"
#include "model/interface_rules.hpp"
#include "model/layer_stack.hpp"
#include "model/random.hpp"

namespace skinfit {

/// How a ray ends.
enum class Exit { surface, reflected, transmitted, absorbed };

/// One ray's walk below the skin's surface, [KA04, Sec. 3]. The polar cosine alone decides where it goes: azimuths
/// are uniform and nothing in the layers depends on them. `Azimuth` follows the ray's azimuth or ignores it; the walk
/// is the same, number by number. `Random` gives the uniform numbers of an attempt at an event.
///
/// `on_run(layer, cosine, xi)` is called for each completed run with the layer's number, the cosine to the normal and
/// the uniform number of the run's absorption test; the ray ends as absorbed where it returns false.
template <class Azimuth, class Random = RandomRay>
class BasicRandomWalk {
public:
    /// `stack` must outlive the walk.
    BasicRandomWalk(const LayerStack& stack, const Random& random) : stack_(&stack), random_(random) {}

    /// Whether a ray of incidence cosine `cosine` is reflected at the surface, and where it goes if not.
    struct FirstHit {
        bool reflected;
        double refracted_cosine;
    };
    /// By the numbers of event 0; `cosine` from 0 to 1.
    [[nodiscard]] FirstHit first_hit(double cosine) const {
        const FresnelInterface& surface = stack_->between(-1, 0);
        return {.reflected = random_.uniforms(0, 0)[0] < surface.reflectance(cosine),
                .refracted_cosine = surface.transmitted_cosine(cosine)};
    }

    /// Follows the ray that has entered the topmost layer with `cosine` until it leaves or is absorbed.
    template <class OnRun>
    [[nodiscard]] Exit below_surface(double cosine, OnRun&& on_run) {
        enter(cosine);
        FourUniforms next_xi = random_.uniforms(1, 0);
        for (std::uint32_t event = 1;; ++event) {
            const FourUniforms xi = next_xi;
            next_xi = random_.uniforms(event + 1, 0);  // drawn early: its latency hides behind this event
            if (const std::optional<Exit> exit = follow_event(event, xi, on_run)) return *exit;
        }
    }

    /// The same event by event, for walks that choose their numbers as they go: the ray enters the topmost layer, ...
    void enter(double cosine) {
        layer_ = 0;
        step_ = down;
        bounced_ = false;
        cosine_ = cosine;
    }
    /// ... and each event, from 1 on, scatters it with the numbers `xi`, moves it through its layer to the next
    /// interface and there on or back.
    template <class OnRun>
    std::optional<Exit> follow_event(std::uint32_t event, const FourUniforms& xi, OnRun&& on_run) {
        const bool completed = in_dermis(layer_) ? scatter_in_dermis(event, xi) : scatter_forward(event, xi);
        if (completed && !on_run(layer_, cosine_, xi[3])) return Exit::absorbed;
        cross_interface(xi[2]);
        if (layer_ < 0) return Exit::reflected;
        if (layer_ == stack_->layers) return Exit::transmitted;
        return std::nullopt;
    }

    /// Where the ray is and what it will do next.
    struct State {
        int layer;
        bool upward;
        bool bounced;  ///< reflected at interface 3, 4 or 5
        double cosine;
    };
    /// Where the ray is, and whither it goes.
    [[nodiscard]] State state() const { return {layer_, step_ != down, bounced_, cosine_}; }
    /// The numbers of the attempts to come.
    void set_random(const Random& random) { random_ = random; }

    /// The direction of a ray that has left through the top or the base, outside: its cosine to the normal and its
    /// azimuth.
    [[nodiscard]] double exit_cosine() const { return cosine_; }
    [[nodiscard]] const Azimuth& azimuth() const { return azimuth_; }

private:
    static constexpr int down = 1;

    /// Stratum corneum and epidermis: a direction that has turned back is drawn again. (open in [KA04])
    bool scatter_forward(std::uint32_t event, const FourUniforms& xi) {
        Deflection deflection = forward_deflection(xi[0], xi[1]);
        double next = deflected_cosine(cosine_, deflection);
        for (std::uint32_t attempt = 1; next <= 0.0; ++attempt) {
            const FourUniforms again = random_.uniforms(event, attempt);
            deflection = forward_deflection(again[0], again[1]);
            next = deflected_cosine(cosine_, deflection);
        }
        azimuth_.deflect(cosine_, deflection);
        cosine_ = next;
        return true;
    }

    [[nodiscard]] Deflection forward_deflection(double polar_xi, double azimuth_xi) const {
        const double polar = stack_->forward[static_cast<std::size_t>(layer_)].polar_angle(polar_xi);
        return {.cosine = small_cosine(polar), .sine = small_sine(polar), .azimuth_turns = azimuth_xi};
    }

    /// The dermis: the Rayleigh test where the edition asks for one, else diffuse. Returns false where the ray has
    /// turned back, which ends the run without an absorption test. (open in [KA04])
    bool scatter_in_dermis(std::uint32_t event, const FourUniforms& xi) {
        const bool asks = asks_for_rayleigh(stack_->edition, step_ == down, bounced_);
        // [KA04, Eq. 3]
        const double share = asks ? 1.0 - decay(stack_->rayleigh_depth[static_cast<std::size_t>(layer_)] / cosine_) : 0;
        if (xi[0] >= share) {
            cosine_ = DiffuseScattering::cosine(xi[1]);
            azimuth_.draw([&] { return random_.uniforms(event, 1)[0]; });
            return true;
        }
        // A number that has passed the test is uniform below the share it was tested against.
        const double polar_cosine = stack_->rayleigh.cosine(xi[0] / share);
        const double sine_squared = 1.0 - polar_cosine * polar_cosine;
        const Deflection deflection{
            .cosine = polar_cosine, .sine = std::sqrt(sine_squared > 0.0 ? sine_squared : 0.0), .azimuth_turns = xi[1]};
        const double next = deflected_cosine(cosine_, deflection);
        azimuth_.deflect(cosine_, deflection);
        cosine_ = std::abs(next);
        if (next < 0.0) step_ = -step_;
        return next >= 0.0;
    }

    /// The next interface in the ray's direction reflects or transmits it. [KA04, Sec. 3.1]
    void cross_interface(double xi) {
        const int beyond = layer_ + step_;
        const InterfaceKind kind = interface_kind(stack_->base, stack_->layers, beyond);
        if (kind == InterfaceKind::open) {
            layer_ = beyond;
            return;
        }
        if (kind == InterfaceKind::mirror) {
            reflect(beyond);
            return;
        }
        const FresnelInterface& interface = stack_->between(layer_, beyond);
        const double transmitted_cosine = interface.transmitted_cosine(cosine_);
        if (transmitted_cosine == 0.0 || interface.reflects(xi, cosine_, transmitted_cosine)) {
            reflect(beyond);
        } else {
            layer_ = beyond;
            cosine_ = transmitted_cosine;
        }
    }

    void reflect(int beyond) {
        bounced_ = bounced_ || bounces(layer_, beyond);
        step_ = -step_;
    }

    const LayerStack* stack_;
    Random random_;
    int layer_ = 0;         // -1: left through the top; stack.layers: left through the base
    int step_ = down;       // to the next layer
    bool bounced_ = false;  // reflected at interface 3, 4 or 5
    double cosine_ = 1.0;
    [[no_unique_address]] Azimuth azimuth_;
};

/// The walk for shares of light, and that for directions.
using RandomWalk = BasicRandomWalk<IgnoredAzimuth>;
using DirectionalRandomWalk = BasicRandomWalk<FollowedAzimuth>;

/// How the rays of one wavelength ended; the counts sum to `rays` exactly.
struct WalkCounts {
    std::uint64_t rays = 0;
    std::uint64_t surface_reflected = 0;
    std::uint64_t subsurface_reflected = 0;
    std::uint64_t transmitted = 0;
    PerLayer<std::uint64_t> absorbed{};

    WalkCounts& operator+=(const WalkCounts& other);
    bool operator==(const WalkCounts&) const = default;
};

/// Which rays to follow.
struct WalkOptions {
    double incidence_rad = 0.0;  ///< 0 to below pi/2
    std::uint64_t rays = 100'000;
    std::uint64_t seed = 1;
};

/// The analog walk: each ray survives or is absorbed run by run. One result per wavelength of `wavelengths_nm`; the
/// same for any number of threads. Throws InputError for a wavelength outside the tables.
[[nodiscard]] std::vector<WalkCounts> random_walk(const Sample& sample, const std::vector<double>& wavelengths_nm,
                                                  const WalkOptions& options);

}  // namespace skinfit
