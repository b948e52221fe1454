// A terminal nobody sits at.
#pragma once

#include <string>

namespace orrery::test {

class PseudoTerminal {
public:
    PseudoTerminal();
    ~PseudoTerminal();
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;

    /// For the program: its side.
    int program_side() const { return program_; }

    /// Waits until `text` was shown; false when that takes longer than a slow machine explains.
    bool shows(const std::string& text);

    /// Everything shown so far.
    const std::string& shown();

private:
    bool read_more(int milliseconds);

    int ours_ = -1;
    int program_ = -1;
    std::string shown_;
};

}  // namespace orrery::test
