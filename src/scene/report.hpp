// Where the parts of the reader put the faults they find.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "scene/read.hpp"
#include "scene/spelling.hpp"

namespace orrery {

/// Diagnostics in order of arrival. Warnings in the same words are one, at the first one's place and with their number.
/// The first 1000 of each severity are kept and the rest counted, so that a file of a million faults does not make a
/// gigabyte of messages.
class Report {
public:
    static constexpr std::size_t kept_per_severity = 1000;

    void add(Severity severity, std::string where, std::string message);

    bool has_errors() const { return errors_ > 0; }

    /// The nearest-word search shares one budget per file.
    Spelling& spelling() { return spelling_; }

    /// Everything collected, and a closing line for what was only counted.
    std::vector<Diagnostic> take();

private:
    std::vector<Diagnostic> diagnostics_;
    std::map<std::string, std::size_t, std::less<>> alike_;  ///< by words, how many warnings beyond the first
    std::size_t errors_ = 0;
    std::size_t warnings_ = 0;
    Spelling spelling_;
};

}  // namespace orrery
