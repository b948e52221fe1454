// A registry: the entries of one root list by id.
#pragma once

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/fields.hpp"
#include "system/printable.hpp"

namespace orrery {

template <class Entry>
struct Registry {
    std::string_view kind;              ///< what an entry is called in messages: "material"
    bool is_readable = true;            ///< false when the list itself is missing: one message is enough
    std::vector<std::string_view> ids;  ///< in file order
    /// By id; empty: faulty, and reported where it stands. A map, which no choice of ids makes slow.
    std::map<std::string_view, std::optional<Entry>> entries;
};

/// Reads the list `key` of the root with `read_entry(Fields&) -> std::optional<Entry>`. An entry without an id is an
/// error even though nothing can refer to it: the file is not of the format.
template <class Entry, class ReadEntry>
Registry<Entry> read_registry(Fields& root, std::string_view key, std::string_view kind,
                              const std::set<std::string_view>& used, Report& report, const ReadEntry& read_entry) {
    Registry<Entry> registry{.kind = kind, .ids = {}, .entries = {}};
    const std::optional<Node> list = root.list(key, fmt::format("a list of {} (empty will do)", key));
    registry.is_readable = list.has_value();
    const std::string expected = fmt::format("a {} object", kind);
    for (std::size_t i = 0; list && i < list->size(); ++i) {
        const Node node(*list, i);
        Fields fields(node, expected, report);
        const auto id = fields.is_object() ? fields.text("id", "a string") : std::nullopt;
        if (!id) continue;

        fields.judge(used.contains(*id) ? Severity::error : Severity::warning);
        std::optional<Entry> entry = read_entry(fields);
        fields.finish();
        if (registry.entries.try_emplace(*id, std::move(entry)).second) {
            registry.ids.push_back(*id);
        } else {
            report.add(
                Severity::error, node.where("id"),
                fmt::format("found the id {} a second time, expected ids unique among the {}", in_quotes(*id), key));
        }
    }
    return registry;
}

/// The entry that the text at `node`, a part of `owner`, names. Null where there is none, which is reported, and where
/// the entry is faulty, which has been.
template <class Entry>
const Entry* look_up(const Node& node, const Registry<Entry>& registry, Fields& owner, Report& report) {
    if (!registry.is_readable) return nullptr;
    const auto id = node.text();
    const auto found = id ? registry.entries.find(*id) : registry.entries.end();
    if (found != registry.entries.end()) return found->second ? &*found->second : nullptr;

    std::string message = fmt::format("found {}, expected the id of a {}", node.describe(), registry.kind);
    if (registry.ids.empty()) {
        message += fmt::format("; no {} is declared", registry.kind);
    } else if (id) {
        const std::string_view near = report.spelling().nearest(*id, registry.ids);
        if (!near.empty()) message += fmt::format("; the nearest is {}", in_quotes(near));
    }
    owner.fault_at(node, std::move(message));
    return nullptr;
}

}  // namespace orrery
