#include "scene/report.hpp"

#include <fmt/format.h>

#include <utility>

namespace orrery {

void Report::add(Severity severity, std::string where, std::string message) {
    if (severity == Severity::warning) {
        if (const auto told = alike_.find(message); told != alike_.end()) {
            ++told->second;
            return;
        }
        if (warnings_ < kept_per_severity) alike_.emplace(message, 0);
    }
    std::size_t& count = severity == Severity::error ? errors_ : warnings_;
    if (++count > kept_per_severity) return;
    diagnostics_.push_back({severity, std::move(where), std::move(message)});
}

std::vector<Diagnostic> Report::take() {
    for (Diagnostic& diagnostic : diagnostics_) {
        const auto alike = alike_.find(diagnostic.message);
        if (diagnostic.severity == Severity::warning && alike != alike_.end() && alike->second > 0)
            diagnostic.message += fmt::format("; {} more like it", alike->second);
    }
    const auto close = [&](Severity severity, std::size_t count, const char* name) {
        if (count <= kept_per_severity) return;
        diagnostics_.push_back({severity, "", fmt::format("{} more {} not shown", count - kept_per_severity, name)});
    };
    close(Severity::error, errors_, "errors");
    close(Severity::warning, warnings_, "warnings");
    return std::move(diagnostics_);
}

}  // namespace orrery
