#include "cli/film_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <map>

#include "cli/film_subject.hpp"
#include "cli/help.hpp"
#include "cli/process.hpp"
#include "image/atomic_file.hpp"
#include "scene/counted.hpp"
#include "scene/image_memory.hpp"
#include "system/file_descriptor.hpp"
#include "system/memory.hpp"
#include "wavefront/passes.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, std::string_view why) {
    throw UsageError(fmt::format("--film: {}: {}", file.string(), why));
}

/// Runs `work` and puts the file's name before what it complains about.
template <class Work>
auto naming(const fs::path& file, const Work& work) {
    try {
        return work();
    } catch (const std::runtime_error& fault) {
        throw std::runtime_error(fmt::format("{}: {}", file.string(), fault.what()));
    }
}

FilmSource source_of(const fs::path& file) {
    // O_NONBLOCK: opening a pipe must not wait for a writer, it is refused below.
    const auto input = std::make_shared<FileDescriptor>(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!input->is_open()) throw_system_error(file, "cannot open", errno);
    struct stat status = {};
    if (::fstat(input->number(), &status) != 0) throw_system_error(file, "cannot read", errno);
    if (!S_ISREG(status.st_mode)) throw std::runtime_error(fmt::format("{}: not a regular file", file.string()));
    // Sections are small: fewer and larger calls of the system.
    return [input, buffer = std::vector<std::byte>(1 << 20), filled = std::size_t{0},
            used = std::size_t{0}](std::span<std::byte> bytes) mutable {
        if (used == filled) {
            ssize_t count = 0;
            do {
                count = ::read(input->number(), buffer.data(), buffer.size());
            } while (count < 0 && errno == EINTR);
            if (count < 0) throw std::system_error(errno, std::generic_category(), "cannot read");
            filled = static_cast<std::size_t>(count);
            used = 0;
        }
        const std::size_t count = std::min(bytes.size(), filled - used);
        std::copy_n(buffer.data() + used, count, bytes.data());
        used += count;
        return count;
    };
}

/// More samples for a film that has a fixed number of them, or is to have.
void ask_more(const fs::path& file, const Plan& plan, const Pattern& all, Ledger& ledger) {
    const std::uint32_t wanted = all.samples();
    const Estimator estimator = plan.settings().estimator;
    for (std::size_t i = 0; i < ledger.state().regions.size(); ++i) {
        FilmRegion& region = ledger.state().regions[i];
        const std::uint64_t has = region.taken + region.asked();
        if (!ledger.state().shard.has(i) || has == wanted) continue;
        const std::string samples = fmt::format("it is of {} per pixel, ", counted(has, "sample"));
        if (has > wanted) refuse(file, samples + fmt::format("and {} are asked: they cannot become fewer", wanted));
        if (estimator == Estimator::stratified)
            refuse(file, samples + fmt::format("stratified over a grid of its own, and {} are another grid: going on "
                                               "would lose them. --error and --time go on from any film; with "
                                               "--estimator uniform or sobol --spp does, too",
                                               wanted));
        if (estimator == Estimator::sobol && region.taken % 2 == 1)
            refuse(file, samples + "which is one of a pair: going on would lose it");
        region.strata = 1;
        region.visits = wanted - region.taken;
    }
}

/// A film of a fixed number of samples becomes that of a render in passes, whose first is over.
std::unique_ptr<Ledger> in_passes(const fs::path& file, Ledger& ledger, const Plan& plan) {
    const Ledger::Samples samples = ledger.samples();
    if (samples.asked > 0)
        refuse(file, "a part of its samples is missing: without --error and --time it can be finished first");
    if (plan.settings().estimator == Estimator::sobol && samples.most % 2 == 1)
        refuse(file, "its one sample per pixel is one of a pair: going on would lose it");
    FilmState state = Passes::layout();
    state.passes = 1;
    state.seconds = ledger.state().seconds;
    state.regions.resize(state.tiling(ledger.film().width(), ledger.film().height()).size());
    for (FilmRegion& region : state.regions) region.taken = samples.most;
    state.regions.front().dropped = samples.dropped;
    return std::make_unique<Ledger>(std::move(ledger.film()), std::move(state));
}

/// Throws UsageError where the films are not all parts of one.
void require_shards_of_one(const std::vector<fs::path>& files, const std::vector<FilmReader>& readers) {
    const FilmReader& first = readers.front();
    const std::uint32_t of = first.state().shard.of;
    std::map<std::uint32_t, fs::path> found;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const FilmReader& reader = readers[i];
        const Shard shard = reader.state().shard;
        std::vector<std::string> list = differences_of_shards(reader.subject(), first.subject());
        if (shard.of != of) list.push_back(fmt::format("parts: found one of {}, expected one of {}", shard.of, of));
        const bool alike = reader.width() == first.width() && reader.height() == first.height() &&
                           reader.contrasting() == first.contrasting() && reader.state().side == first.state().side &&
                           reader.state().halves == first.state().halves;
        if (list.empty() && !alike) list.emplace_back("its tiles are others");
        if (!list.empty())
            throw UsageError(fmt::format("{}: is no part of the image that {} is of: {}", files[i].string(),
                                         files.front().string(), fmt::join(list, "; ")));
        const auto [place, is_new] = found.emplace(shard.number, files[i]);
        if (!is_new)
            throw UsageError(fmt::format("{}: is the same part of the image, {}/{}, as {}, expected every part once",
                                         files[i].string(), shard.number, of, place->second.string()));
    }
    if (found.size() == of) return;
    constexpr std::size_t most_named = 20;
    std::vector<std::string> missing;
    for (std::uint32_t i = 1; i <= of && missing.size() <= most_named; ++i)
        if (!found.contains(i)) missing.push_back(fmt::format("{}/{}", i, of));
    if (missing.size() > most_named) missing.back() = "...";
    throw UsageError(
        fmt::format("{} of the image's {} parts are missing: {}", of - found.size(), of, fmt::join(missing, ", ")));
}

/// A name beside others that no file has.
fs::path free_name(const fs::path& folder, const std::string& stem) {
    for (int i = 0;; ++i) {
        fs::path name = folder / fmt::format("{}{}.film", stem, i > 0 ? fmt::format("-{}", i) : "");
        std::error_code error;
        if (!fs::exists(fs::symlink_status(name, error))) return name;
    }
}

}  // namespace

FilmReader open_film(const fs::path& file) {
    FilmSource source = source_of(file);
    return naming(file, [&] { return FilmReader(std::move(source)); });
}

std::unique_ptr<Ledger> ledger_for(const fs::path& file, const FilmReader& reader) {
    if (const auto fault = too_many_pixels(reader.width(), reader.height(), memory_limit()))
        throw std::runtime_error(fmt::format("{}: {}", file.string(), *fault));
    if (fs::file_size(file) < reader.least_size())
        throw std::runtime_error(fmt::format("{}: damaged: the file ends early", file.string()));
    return std::make_unique<Ledger>(Film(reader.width(), reader.height(), reader.contrasting()), reader.state());
}

void read_film(const fs::path& file, FilmReader& reader, Ledger& into) {
    naming(file, [&] { reader.read(into.film(), into.state().regions); });
}

std::unique_ptr<Ledger> resume_film(const fs::path& file, const Plan& plan, const Goal& goal, Shard shard,
                                    const FilmSubject& subject) {
    FilmReader reader = open_film(file);
    if (const auto list = differences(reader.subject(), subject); !list.empty())
        refuse(file, fmt::format("is the film of another render: {}", fmt::join(list, "; ")));
    const FilmState& state = reader.state();
    if (state.shard.number != shard.number || state.shard.of != shard.of)
        refuse(file, fmt::format("is the film of another render: shard: found {}/{}, expected {}/{}",
                                 state.shard.number, state.shard.of, shard.number, shard.of));
    if (state.halves && !goal.asked()) refuse(file, "was begun with --error or --time, expected one of these");
    const Window window = plan.settings().window();
    if (reader.width() != window.width() || reader.height() != window.height() ||
        reader.contrasting() != contrasting_of(plan.settings()))
        throw std::runtime_error(fmt::format("{}: damaged: it is not of the size it says", file.string()));
    std::unique_ptr<Ledger> ledger = ledger_for(file, reader);
    read_film(file, reader, *ledger);
    if (!goal.asked()) {
        ask_more(file, plan, whole_pattern(plan), *ledger);
    } else if (!state.halves) {
        return in_passes(file, *ledger, plan);
    }
    return ledger;
}

std::string develop_hint(const fs::path& film) {
    return fmt::format("{} has what was rendered: {} develop {} -o IMAGE", film.string(), typed_command(),
                       film.string());
}

std::unique_ptr<Ledger> join_films(const std::vector<fs::path>& files, bool unfinished, FilmSubject& subject) {
    std::vector<FilmReader> readers;
    for (const fs::path& file : files) readers.push_back(open_film(file));
    require_shards_of_one(files, readers);
    subject = readers.front().subject();
    std::unique_ptr<Ledger> whole = ledger_for(files.front(), readers.front());
    for (std::size_t i = 0; i < files.size(); ++i) {
        read_film(files[i], readers[i], *whole);
        whole->state().shard = readers[i].state().shard;
        const Ledger::Samples samples = whole->samples();
        if (!readers[i].state().finished && !unfinished)
            throw UsageError(
                fmt::format("{}: is not finished: {:.3g} % of the samples asked so far are there, expected all (render "
                            "--film goes on) or --unfinished",
                            files[i].string(), 100 * samples.taken / std::max(samples.taken + samples.asked, 1.0)));
    }
    whole->state().shard = {};
    return whole;
}

void save_film(const fs::path& file, const Ledger& ledger, const FilmSubject& subject) {
    AtomicFile whole(file);
    constexpr std::size_t enough = 1 << 20;
    std::vector<std::byte> buffer;
    ledger.write(subject, [&](std::span<const std::byte> bytes) {
        buffer.insert(buffer.end(), bytes.begin(), bytes.end());
        if (buffer.size() < enough) return;
        whole.write(buffer);
        buffer.clear();
    });
    whole.write(buffer);
    whole.commit();
}

void rescue_film(const fs::path& output, const Ledger& ledger, const FilmSubject& subject) {
    std::error_code none;
    for (const fs::path& folder : {output.parent_path(), fs::temp_directory_path(none)}) {
        const fs::path file = free_name(folder, output.stem().string());
        try {
            save_film(file, ledger, subject);
        } catch (const std::exception&) {
            continue;
        }
        print_line(develop_hint(file));
        return;
    }
    print_error("the film could not be kept either: the render is lost");
}

}  // namespace orrery
