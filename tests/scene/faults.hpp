// A table of single faults: how to make each in the sound world, and what the reader must say.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "scene/world.hpp"

namespace orrery::test {

/// A row of faults.json. Each makes exactly one diagnostic.
struct Fault {
    std::string name;                     ///< letters, digits and underscores
    std::string at;                       ///< JSON pointer into world()
    std::optional<Json> put;              ///< the value put there; absent: what is there is removed
    Severity severity = Severity::error;  ///< an error unless the row tells
    std::string where;                    ///< pointer the diagnostic must carry; `at` unless the row tells
    std::vector<std::string> says;        ///< parts of the message: found, expected, nearest
    /// Whether scene.schema.json rejects it, too; true unless the row tells. A schema cannot see what relates two
    /// places of a file (ids and what they name, which entries are used), what depends on rounding or on
    /// the operating system, nor the bound of eta, which unused entries of real files break.
    bool schema_sees_it = true;
};

/// For the messages of GoogleTest.
void PrintTo(const Fault& fault, std::ostream* stream);

const std::vector<Fault>& faults();

/// world() with the fault in it.
Json broken_world(const Fault& fault);

}  // namespace orrery::test
