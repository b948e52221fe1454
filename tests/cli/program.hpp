// The program under test as its users start it: a process with arguments, streams and surroundings.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace orrery::test {

struct Outcome {
    int exit_code = -1;  ///< -1 where a signal ended it
    std::string output;  ///< standard output
    std::string error;   ///< standard error
};

struct Surroundings {
    std::filesystem::path folder = {};         ///< to run in; empty: ours
    std::filesystem::path output = {};         ///< standard output goes to this file; empty: to Outcome::output
    bool output_closed = false;                ///< no standard output at all
    std::optional<rlim_t> largest_file = {};   ///< bytes any file may have: a disk that is full there
    std::optional<rlim_t> address_space = {};  ///< bytes of memory
    int terminal = -1;                         ///< standard error is this descriptor; -1: Outcome::error
    std::string columns = {};                  ///< the environment's COLUMNS; empty: none
    std::string typed = {};                    ///< the environment's ORRERY_COMMAND; empty: none
    int ignored_signal = 0;                    ///< as under nohup; 0: none
    std::optional<rlim_t> tasks = {};  ///< threads and processes of the user the program runs as, nobody for root
};

/// `orrery` with these arguments, running. Killed with its owner: no test leaves a process behind.
class Program {
public:
    explicit Program(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void send(int signal) const;
    Outcome wait();

private:
    TemporaryFolder streams_;
    pid_t process_;
};

/// From start to end.
Outcome orrery(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});

/// A scene of the repository: scene_file("tests/lens.json").
std::string scene_file(const std::string& name);

/// How often `part` stands in `text`.
std::size_t count_of(const std::string& part, const std::string& text);

}  // namespace orrery::test
