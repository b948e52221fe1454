#include "scene/report.hpp"

#include <fmt/format.h>

#include <utility>

namespace orrery {

void Report::add(Severity severity, std::string where, std::string message) {
    std::size_t& count = severity == Severity::error ? errors_ : warnings_;
    if (++count > kept_per_severity) return;
    diagnostics_.push_back({severity, std::move(where), std::move(message)});
}

std::vector<Diagnostic> Report::take() {
    const auto close = [&](Severity severity, std::size_t count, const char* name) {
        if (count <= kept_per_severity) return;
        diagnostics_.push_back({severity, "", fmt::format("{} more {} not shown", count - kept_per_severity, name)});
    };
    close(Severity::error, errors_, "errors");
    close(Severity::warning, warnings_, "warnings");
    return std::move(diagnostics_);
}

}  // namespace orrery
