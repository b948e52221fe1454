#include "cli/overrides.hpp"

#include <fmt/format.h>

#include "cli/exit_code.hpp"
#include "scene/image_memory.hpp"
#include "system/memory.hpp"

namespace orrery {
namespace {

constexpr std::uint32_t deepest_whitted = 20;  // as in a scene file

template <class Value>
void replace(Value& setting, const std::optional<Value>& override) {
    if (override) setting = *override;
}

}  // namespace

void apply(const Overrides& overrides, RenderSettings& settings) {
    replace(settings.integrator, overrides.integrator);
    replace(settings.samples, overrides.samples);
    replace(settings.depth, overrides.depth);
    replace(settings.seed, overrides.seed);
    replace(settings.estimator, overrides.estimator);
    replace(settings.transport, overrides.transport);
    replace(settings.light_sampling, overrides.light_sampling);
    replace(settings.light_choice, overrides.light_choice);
    replace(settings.roulette, overrides.roulette);
    replace(settings.roulette_from, overrides.roulette_from);
    replace(settings.precision, overrides.precision);
    if (overrides.tonemap) settings.tonemap = overrides.tonemap;
    if (overrides.size) {
        settings.width = overrides.size->width;
        settings.height = overrides.size->height;
    }

    // Asked of the settings as they are now: `--integrator wrt` may be what makes the scene's own depth too much.
    if (settings.integrator == Integrator::whitted && settings.depth > deepest_whitted) {
        throw UsageError(fmt::format("{}: found {}, expected 0 to {} with --integrator wrt",
                                     overrides.depth ? "--depth" : "the scene's depth", settings.depth,
                                     deepest_whitted));
    }
    if (const auto fault = too_many_pixels(settings.width, settings.height, memory_limit()))
        throw UsageError("--size: " + *fault);
}

ToneMap tone_mapper(const RenderSettings& settings) {
    return settings.tonemap.value_or(settings.integrator == Integrator::depth ? ToneMap::none : ToneMap::sigmoid);
}

}  // namespace orrery
