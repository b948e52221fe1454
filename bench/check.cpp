#include "bench/check.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>

namespace orrery::bench {

namespace {

using kernels::Range;
using kernels::Runs;

constexpr double close_enough = 1e-3;
constexpr double tolerated_share = 1.0 / 200, tolerated_few = 3;

/// A field of the results: its name, where it begins, and how many words a record takes of it.
struct Column {
    const char* name;
    const std::uint32_t* words;
    std::size_t width;
    bool number;
    bool by_slot;  ///< a table of slots, not of records
};

std::vector<Column> columns(const WaveStorage<float>& storage, const StageCall& call) {
    std::vector<Column> found;
    const std::uint32_t by_slot = call.results & chain_part;
    for (const std::uint32_t parts : {call.results & ~by_slot, by_slot})
        each_array(storage, parts, 1, 1, [&]<class T>(const char* name, const T* array, std::size_t words) {
            found.push_back({name, reinterpret_cast<const std::uint32_t*>(array), words, std::is_same_v<T, float>,
                             parts == by_slot});
        });
    return found;
}

std::vector<std::uint32_t> records(const Runs& runs) {
    std::vector<std::uint32_t> list;
    for (const Range& run : runs.run)
        for (std::uint32_t i = 0; i < run.count; ++i) list.push_back(run.begin + i);
    return list;
}

bool close(const Column& a, std::size_t i, const Column& b, std::size_t j) {
    for (std::size_t w = 0; w < a.width; ++w) {
        if (a.number && a.width == 4 && w == 3) break;  // the unused number of a slot's radiance
        const std::uint32_t x = a.words[i * a.width + w], y = b.words[j * b.width + w];
        if (x == y) continue;
        if (!a.number) return false;
        const double p = std::bit_cast<float>(x), q = std::bit_cast<float>(y);
        if (!(std::abs(p - q) <= close_enough * std::max(1.0, std::max(std::abs(p), std::abs(q))))) return false;
    }
    return true;
}

/// What identifies a record: the slot where there is one, since queues of survivors close up; else the place.
std::map<std::uint32_t, std::uint32_t> by_key(const std::vector<Column>& columns,
                                              const std::vector<std::uint32_t>& at) {
    const Column* slot = nullptr;
    for (const Column& column : columns)
        if (std::strcmp(column.name, "slot") == 0) slot = &column;
    std::map<std::uint32_t, std::uint32_t> keyed;
    for (const std::uint32_t i : at) keyed[slot != nullptr ? slot->words[i] : i] = i;
    return keyed;
}

/// Stages leave some fields of their results alone, such as the targets of shadow rays that all end on one sphere: what
/// is there must not be left over from another call.
void clear(WaveStorage<float>& storage, std::uint32_t parts) {
    each_array(storage, parts, kernels::round_up(storage.slot_count), kernels::ray_capacity(storage.slot_count),
               [](const char*, auto* array, std::size_t words) { std::memset(array, 0, words * sizeof *array); });
}

struct Difference {
    std::size_t records = 0;    ///< compared
    std::size_t different = 0;  ///< of them
    const char* field = "";     ///< of the first one
};

Difference difference(const StageCall& call, const WaveStorage<float>& expected, Runs expected_runs,
                      const WaveStorage<float>& found, Runs found_runs, bool to_the_byte) {
    if (call.results & radiance_part && !(call.results & ray_part)) {
        expected_runs = found_runs = {};  // by slot, whatever records the stage ran over
        expected_runs.run[0] = found_runs.run[0] = {0, call.slots};
    }
    const auto a = columns(expected, call), b = columns(found, call);
    const auto a_records = by_key(a, records(expected_runs)), b_records = by_key(b, records(found_runs));
    Difference result;
    result.records = std::max(a_records.size(), b_records.size());
    const auto differ = [&](const char* field) {
        if (result.different++ == 0) result.field = field;
    };
    for (const auto& [key, i] : a_records) {
        const auto other = b_records.find(key);
        if (other == b_records.end() || (to_the_byte && other->second != i)) {
            differ("missing or misplaced");
            continue;
        }
        for (std::size_t c = 0; c < a.size(); ++c) {
            const std::size_t at_a = a[c].by_slot ? key : i, at_b = b[c].by_slot ? key : other->second;
            const bool same = to_the_byte ? std::memcmp(a[c].words + at_a * a[c].width, b[c].words + at_b * b[c].width,
                                                        4 * a[c].width) == 0
                                          : close(a[c], at_a, b[c], at_b);
            if (same) continue;
            differ(a[c].name);
            break;
        }
    }
    for (const auto& [key, j] : b_records)
        if (!a_records.contains(key)) differ("too many");
    return result;
}

}  // namespace

std::string fault_of(const std::vector<const StageCall*>& calls, const kernels::Stages<float>& stages,
                     Workspace& workspace) {
    const auto& scalar = kernels::stages_for(Isa::scalar);
    const bool to_the_byte = stages.isa != Isa::sse2;
    Difference sum;
    for (const StageCall* call : calls) {
        for (WaveStorage<float>* storage : {&workspace.expected, &workspace.work}) {
            clear(*storage, call->results);
            call->before.restore(*storage);
        }
        const Runs expected = call->run(scalar, workspace.expected);
        const Runs found = call->run(stages, workspace.work);
        const auto d = difference(*call, workspace.expected, expected, workspace.work, found, to_the_byte);
        if (sum.different == 0) sum.field = d.field;
        sum.records += d.records;
        sum.different += d.different;
    }
    const double tolerated = to_the_byte ? 0 : tolerated_few + tolerated_share * static_cast<double>(sum.records);
    if (static_cast<double>(sum.different) <= tolerated) return {};
    return fmt::format("{} of {} records are not the scalar stage's ({})", sum.different, sum.records, sum.field);
}

}  // namespace orrery::bench
