#include <span>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/standard_streams.hpp"
#include "image/atomic_file.hpp"
#include "worlds/write_world.hpp"

namespace orrery {

int generate_command(const Arguments& arguments) {
    const Generation& g = arguments.generation;
    const worlds::World world = worlds::make_world(g.kind, g.spheres, g.seed);
    const std::string_view name = worlds::kind_names[static_cast<std::size_t>(g.kind)];
    if (!g.output) {
        worlds::write_world(world, g.spheres, name, print_result);
        return exit_code::done;
    }
    AtomicFile file(*g.output);
    worlds::write_world(world, g.spheres, name,
                        [&](std::string_view text) { file.write(std::as_bytes(std::span(text))); });
    file.commit();
    print_name(*g.output);
    return exit_code::done;
}

}  // namespace orrery
