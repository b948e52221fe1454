// A registry: the entries of one root list by id.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/fields.hpp"
#include "system/printable.hpp"

namespace orrery {

template <class Entry>
struct Registry {
    std::string_view kind;                      ///< what an entry is called in messages: "material"
    bool is_readable = true;                    ///< false when the list itself is missing: one message is enough
    NameMap places;                             ///< id -> place in the two below, which are in file order
    std::vector<std::optional<Entry>> entries;  ///< empty entry: faulty, and reported where it stands
    std::vector<std::string_view> ids;
};

/// Reads the list `key` of the root with `read_entry(Fields&) -> std::optional<Entry>`. An entry without an id is an
/// error even though nothing can refer to it: the file is not of the format.
template <class Entry, class ReadEntry>
Registry<Entry> read_registry(Fields& root, std::string_view key, std::string_view kind, const NameSet& used,
                              Report& report, const ReadEntry& read_entry) {
    Registry<Entry> registry{.kind = kind, .places = {}, .entries = {}, .ids = {}};
    const std::optional<Node> list = root.list(key, fmt::format("a list of {} (empty will do)", key));
    registry.is_readable = list.has_value();
    const std::string expected = fmt::format("a {} object", kind);
    for (std::size_t i = 0; list && i < list->size(); ++i) {
        const Node node(*list, i);
        Fields fields(node, expected, report);
        const std::optional<Name> id = fields.is_object() ? fields.name("id", "a string") : std::nullopt;
        if (!id) continue;

        fields.judge(used.contains(*id) ? Severity::error : Severity::warning);
        std::optional<Entry> entry = read_entry(fields);
        fields.finish();
        if (registry.places.insert(*id, static_cast<std::uint32_t>(registry.ids.size()))) {
            registry.entries.push_back(std::move(entry));
            registry.ids.push_back(node.text(*id));
        } else {
            report.add(Severity::error, node.where("id"),
                       fmt::format("found the id {} a second time, expected ids unique among the {}",
                                   in_quotes(node.text(*id)), key));
        }
    }
    return registry;
}

/// The entry that the text at `node`, a part of `owner`, names. Null where there is none, which is reported, and where
/// the entry is faulty, which has been.
template <class Entry>
const Entry* look_up(const Node& node, const Registry<Entry>& registry, Fields& owner, Report& report) {
    if (!registry.is_readable) return nullptr;
    const std::optional<Name> id = node.name();
    if (const auto place = id ? registry.places.find(*id) : std::nullopt) {
        const std::optional<Entry>& entry = registry.entries[*place];
        return entry ? &*entry : nullptr;
    }

    std::string message = fmt::format("found {}, expected the id of a {}", node.describe(), registry.kind);
    if (registry.ids.empty()) {
        message += fmt::format("; no {} is declared", registry.kind);
    } else if (id) {
        const std::string_view near = report.spelling().nearest(node.text(*id), registry.ids);
        if (!near.empty()) message += fmt::format("; the nearest is {}", in_quotes(near));
    }
    owner.fault_at(node, std::move(message));
    return nullptr;
}

}  // namespace orrery
