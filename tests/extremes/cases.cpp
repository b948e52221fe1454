#include "cases.hpp"

#include <algorithm>

namespace orrery::extremes {

namespace {

/// Groups, and names within them, in the order they first appear in; a case's modes side by side.
std::vector<Case> in_order_of_the_table(const std::vector<Case>& cases) {
    const auto place = [&](auto field, const Case& c) {
        return std::ranges::find(cases, c.*field, field) - cases.begin();
    };
    std::vector<Case> sorted = cases;
    std::ranges::stable_sort(sorted, {},
                             [&](const Case& c) { return std::pair(place(&Case::group, c), place(&Case::name, c)); });
    return sorted;
}

}  // namespace

std::string full_name(const Case& c) { return c.group + ", " + c.name + ", " + c.mode; }

Errors errors_of(const Case& c, std::uint64_t trials) {
    Errors errors;
    Dice dice(full_name(c));
    c.run(errors, trials, dice);
    return errors;
}

std::vector<Case> all_cases() {
    std::vector<Case> cases;
    add_ray_and_sphere(cases);
    add_leaving(cases);
    add_light(cases);
    add_material(cases);
    add_sums(cases);
    add_camera(cases);
    add_relations(cases);
    add_pictures(cases);
    return in_order_of_the_table(cases);
}

}  // namespace orrery::extremes
