// A terminal nobody sits at.
#pragma once

#include <string>

namespace orrery::test {

class PseudoTerminal {
public:
    explicit PseudoTerminal(unsigned short columns = 70);
    ~PseudoTerminal();
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;

    /// For the program: its side.
    int program_side() const { return program_; }
    /// The file by which that side is opened.
    const std::string& name() const { return name_; }

    /// Waits until `text` was shown; false when that takes longer than a slow machine explains.
    bool shows(const std::string& text);

    /// Everything shown so far.
    const std::string& shown();

private:
    bool read_more(int milliseconds);

    int ours_ = -1;
    int program_ = -1;
    std::string name_;
    std::string shown_;
};

}  // namespace orrery::test
