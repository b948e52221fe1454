#include "worlds/world.hpp"

#include <stdexcept>

namespace orrery::worlds {

World make_world(Kind kind, std::uint64_t spheres, std::uint32_t seed) {
    switch (kind) {
        case Kind::random:
            return random_ball(spheres, seed);
        case Kind::lattice:
            return lattice(spheres, seed);
        case Kind::cluster:
            return clusters(spheres, seed);
        case Kind::cosmos:
            return cosmos(spheres, seed);
    }
    throw std::invalid_argument("unknown kind of world");
}

}  // namespace orrery::worlds
