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
#include "scene/printable.hpp"

namespace orrery {

template <class Entry>
struct Registry {
    std::string_view kind;    ///< what an entry is called in messages: "material"
    bool is_readable = true;  ///< false when the list itself is missing: one message about that is enough
    std::map<std::string_view, std::optional<Entry>> entries;  ///< empty entry: faulty, and reported where it stands
    std::vector<std::string_view> ids;                         ///< in file order
};

/// Reads the list `key` of the root with `read_entry(Fields&) -> std::optional<Entry>`. An entry without an id is an
/// error even though nothing can refer to it: the file is not of the format.
template <class Entry, class ReadEntry>
Registry<Entry> read_registry(Fields& root, std::string_view key, std::string_view kind,
                              const std::set<std::string_view>& used, Report& report, const ReadEntry& read_entry) {
    Registry<Entry> registry{.kind = kind, .entries = {}, .ids = {}};
    const std::optional<Node> list = root.list(key, fmt::format("a list of {} (empty will do)", key));
    registry.is_readable = list.has_value();
    for (std::size_t i = 0; list && i < list->value().size(); ++i) {
        const Node node(*list, i);
        const std::string expected = fmt::format("a {} object", kind);
        const std::string* id = nullptr;
        {
            Fields head(node, expected, report);
            if (head.is_object()) id = head.text("id", "a string");
        }
        if (!id) continue;

        Fields fields(node, expected, report, used.contains(*id) ? Severity::error : Severity::warning);
        fields.ignore("id");
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
    const auto* id = node.value().get_ptr<const std::string*>();
    const auto found = id ? registry.entries.find(*id) : registry.entries.end();
    if (found != registry.entries.end()) return found->second ? &*found->second : nullptr;

    std::string message = fmt::format("found {}, expected the id of a {}", describe(node.value()), registry.kind);
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
