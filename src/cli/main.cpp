#include <new>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/signals.hpp"
#include "cli/standard_streams.hpp"
#include "system/memory.hpp"

namespace orrery {
namespace {

int run(int argc, const char* const* argv) {
    const auto read = read_arguments(argc, argv);
    if (const auto* answer = std::get_if<Answer>(&read)) {
        print_message(answer->error);
        print_result(answer->output);
        return answer->exit_code;
    }
    const auto& arguments = std::get<Arguments>(read);
    switch (arguments.command) {
        case Command::render:
            return render_command(arguments);
        case Command::info:
            return info_command(arguments);
        case Command::generate:
            return generate_command(arguments);
        case Command::compare:
            return compare_command(arguments);
    }
    return exit_code::misused;
}

}  // namespace
}  // namespace orrery

int main(int argc, char** argv) {
    using namespace orrery;
    occupy_standard_descriptors();
    install_signal_handlers();
    keep_within_memory();
    try {
        return run(argc, argv);
    } catch (const UsageError& error) {
        print_error(error.what());
        return exit_code::misused;
    } catch (const std::bad_alloc&) {
        print_error("out of memory");
        return exit_code::failed;
    } catch (const std::exception& error) {
        print_error(error.what());
        return exit_code::failed;
    }
}
