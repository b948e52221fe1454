// The surroundings that worlds share.
#pragma once

#include "worlds/world.hpp"

namespace orrery::worlds {

/// For worlds within the unit ball: seen from the front and a little above, a warm lamp on the left, a cool one on the
/// right, a soft sky, and six paints. `sphere` is left empty.
World studio();

}  // namespace orrery::worlds
