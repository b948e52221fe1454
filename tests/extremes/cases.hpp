// What the suite consists of: cases, each of which measures an error and knows the limit we promise. The tests run
// them, and the program that writes the table does, with more trials.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dice.hpp"
#include "errors.hpp"

namespace orrery::extremes {

struct Case {
    std::string group;  ///< what is tested: "met or missed"
    std::string name;   ///< at which extreme: "distance up to 1e8 radii"
    std::string mode;   ///< "float", "float, SSE2", "double"
    std::string unit;   ///< what an error of 1 is
    double limit;       ///< the greatest error we promise
    std::uint64_t trials;
    std::function<void(Errors&, std::uint64_t trials, Dice&)> run;
    std::uint64_t times_on_page = 10;  ///< as many times the trials where the page is made
};

/// "group, name, mode": no two cases share it.
std::string full_name(const Case& c);

/// Runs a case. Its random numbers depend on its full name alone: other cases may come, go and move.
Errors errors_of(const Case& c, std::uint64_t trials);

/// The order is that of the table.
std::vector<Case> all_cases();

void add_ray_and_sphere(std::vector<Case>& cases);
void add_leaving(std::vector<Case>& cases);
void add_light(std::vector<Case>& cases);
void add_material(std::vector<Case>& cases);
void add_sums(std::vector<Case>& cases);
void add_camera(std::vector<Case>& cases);
void add_relations(std::vector<Case>& cases);
void add_pictures(std::vector<Case>& cases);

}  // namespace orrery::extremes
