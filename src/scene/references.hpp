// Which registry entries the composition refers to.
#pragma once

#include <set>
#include <string_view>

#include "scene/json_node.hpp"

namespace orrery {

/// Ids by registry. An entry whose id is here takes part in the image and must be sound; any other may hold anything
/// at the price of a warning.
struct References {
    std::set<std::string_view> cameras, materials, shapes, lights;
};

/// Collects the ids in silence (the shape of an area light is among them through the primitive that carries it),
/// skipping over whatever is malformed: the composition's reader reports that. It runs before the registries are read
/// because it decides the severity of their faults.
References find_references(const Json& root);

}  // namespace orrery
