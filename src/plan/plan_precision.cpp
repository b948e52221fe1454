// Which number type a scene is computed in, and which of its spheres are one surface to that type.
#include <fmt/format.h>

#include "plan/contacts.hpp"
#include "plan/plan.hpp"
#include "system/printable.hpp"

namespace orrery {

namespace {

// In units of half an ulp.
constexpr double same = 8;   ///< four roundings of a coordinate to its neighbour: no file means that
constexpr double near = 64;  ///< so close, surfaces are met in the wrong order too often

/// What the type cannot tell apart.
std::optional<std::string> confusion(const Scene& scene, const Coincidences& found, Precision type) {
    if (found.too_many) return "more spheres stand within a few roundings of others than can be compared";
    if (found.near == 0 || found.nearest.apart > near * unit_roundoff(type)) return std::nullopt;
    const Primitive &a = scene.primitives[found.nearest.first], &b = scene.primitives[found.nearest.again];
    return fmt::format("spheres {} and {} differ by {:.1g} of their coordinates, too little for {}{}", in_quotes(a.id),
                       in_quotes(b.id), found.nearest.apart, name_of(type),
                       found.near > 1 ? fmt::format(", and so may {} more pairs", found.near - 1) : "");
}

std::string pointer_to(std::uint32_t primitive) { return fmt::format("/scene/primitives/{}", primitive); }

}  // namespace

/// What is one surface hangs on the number type, and the number type on what is left: automatic precision goes by
/// double's roundings first, and takes double where float would confuse what then remains.
void Plan::plan_precision() {
    Precision& precision = scene_.settings.precision;
    const Precision listed_in = precision == Precision::binary32 ? precision : Precision::binary64;
    Coincidences found =
        coincidences(scene_.primitives, same * unit_roundoff(listed_in), near * unit_roundoff(Precision::binary32));
    const auto in_float = confusion(scene_, found, Precision::binary32);
    if (found.too_many && listed_in == Precision::binary64)
        found = coincidences(scene_.primitives, same * unit_roundoff(listed_in), near * unit_roundoff(listed_in));
    const auto in_double = confusion(scene_, found, Precision::binary64);
    drop(found.same);

    unit_ = length_unit(scene_);
    // The plainest first.
    const auto against = [&](Precision type, const std::optional<std::string>& confused) {
        if (auto reason = too_coarse(scene_, unit_, type)) return reason;
        return confused ? confused : uncertain_contact(scene_, type);
    };
    const auto against_float = against(Precision::binary32, in_float);
    if (precision == Precision::automatic) precision = against_float ? Precision::binary64 : Precision::binary32;
    if (precision == Precision::binary32) {
        precision_reason_ = against_float.value_or("float is good enough for every feature of this scene");
        if (against_float) warnings_.push_back({Severity::warning, "", *against_float + "; use --precision double"});
        return;
    }
    precision_reason_ = against_float.value_or("asked for; float would do");
    const auto against_double = against(Precision::binary64, in_double);
    if (against_double) warnings_.push_back({Severity::warning, "", *against_double});
}

/// The first listed stays, and all behind move up.
void Plan::drop(const std::vector<Twins>& same_as_earlier) {
    if (same_as_earlier.empty()) return;
    auto& all = scene_.primitives;
    std::size_t lamps = 0;
    std::uint32_t kept = 0;
    auto twin = same_as_earlier.begin();
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        if (twin != same_as_earlier.end() && twin->again == i) {
            if (emits(all[i])) ++lamps;
            ++twin;
        } else {
            if (kept != i) all[kept] = std::move(all[i]);
            ++kept;
        }
    }
    all.resize(kept);

    const Twins& one = same_as_earlier.front();
    std::string message = fmt::format(
        "found the same sphere as {}{}, expected each once; the first listed wins and this one is no part of the image",
        pointer_to(one.first), one.apart > 0 ? " but for roundings" : "");
    if (same_as_earlier.size() > 1)
        message += fmt::format(", nor are {} more that are listed twice", same_as_earlier.size() - 1);
    if (lamps > 0) message += fmt::format("; light of {} of them goes with them", lamps);
    warnings_.push_back({Severity::warning, pointer_to(one.again), std::move(message)});
}

}  // namespace orrery
