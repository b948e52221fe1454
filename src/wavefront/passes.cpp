#include "wavefront/passes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orrery {
namespace {

/// Regions follow the error, so they are small; with a few dozen samples a pixel, half of one fills a wave.
constexpr std::uint32_t region_side = 16;

/// A few black samples must not look like an image without error: so many are enough where the pixels that carry the
/// error are known well, else more.
constexpr std::uint32_t fewest_samples = 8, fewest_in_doubt = 32;
/// Share of the error that may be in doubt (SquaredError::doubt) where fewest_samples are enough.
constexpr double little_doubt = 0.5;
/// Samples of an image without any noise until that is believed.
constexpr double noiseless_samples = 1 << 22;

/// Share of the work that is spread evenly, to learn from.
constexpr double pilot_share = 0.125;
/// The error to aim at, over that asked: or else the last step would be taken again and again.
constexpr double aim = 0.98;
/// How far beyond the error asked the interval's upper end may be. Images of some thousand pixels are always better
/// known; of smaller ones, or where rare paths carry the light, the estimate alone could be lucky.
constexpr double tolerance = 1.2;
/// Weight of the whole image's scatter beside a region's own, which may have missed what is rare.
constexpr double prior = 0.05;
/// Share of the time that is worth starting another pass for.
constexpr double worth_starting = 0.02;
/// Share of the time left that a pass is planned to take: it is lost where it takes longer than what is left.
constexpr double time_to_plan = 0.8;
/// Sample numbers have 32 bits, and a pass at most doubles them.
constexpr std::uint32_t most_samples_ever = 1u << 30;

}  // namespace

FilmState Passes::layout() { return {.side = region_side, .halves = true}; }

Passes::Passes(const Plan& plan, const Goal& goal, const FilmState& state)
    : goal_(goal),
      stratified_(plan.settings().estimator == Estimator::stratified),
      doubling_(plan.settings().estimator == Estimator::sobol && goal.adaptive),
      count_(state.passes),
      in_pilot_(state.pilot),
      share_before_(state.share_before),
      share_after_(state.share_after) {
    const Window window = plan.settings().window();
    const Tiling tiling = state.tiling(window.width(), window.height());
    for (std::size_t i = 0; i < tiling.size(); ++i) {
        const FilmRegion& region = state.regions[i];
        const auto pixels = static_cast<double>(tiling[i].pixels());
        tiles_.push_back(tiling[i]);
        taken_.push_back(static_cast<std::uint32_t>(region.taken + region.asked()));
        regions_.push_back({.pixels = pixels,
                            .taken = static_cast<double>(taken_[i]),
                            .scatter = count_ > 0 ? region.scatter : pixels});
        all_pixels_ += pixels;
        total_ += pixels * taken_[i];
    }
    added_ = total_;  // the rate of all passes together
}

std::uint32_t Passes::least_samples() const { return *std::ranges::min_element(taken_); }
std::uint32_t Passes::most_samples() const { return *std::ranges::max_element(taken_); }

std::size_t Passes::other_half(std::size_t region) const {
    const auto same_tile = [&](std::size_t i) {
        return i < tiles_.size() && tiles_[i].x0 == tiles_[region].x0 && tiles_[i].y0 == tiles_[region].y0;
    };
    if (same_tile(region + 1)) return region + 1;
    if (region > 0 && same_tile(region - 1)) return region - 1;
    return region;  // a tile of one pixel
}

bool Passes::enough_known() const {
    const bool certain = error_.relative.value > 0 && doubt_ < little_doubt;
    return least_samples() >= (certain ? fewest_samples : fewest_in_doubt);
}

void Passes::learn(const std::vector<ErrorSums>& errors) {
    ErrorSums sums;
    for (const ErrorSums& error : errors) sums.add(error);
    error_ = sums.error();
    doubt_ = sums.relative.doubt();

    if (in_pilot_) learn_scatter(errors);
    left_ = 0;
    for (const Region& region : regions_) left_ += region.scatter / region.taken;
}

void Passes::learn_scatter(const std::vector<ErrorSums>& errors) {
    const auto scatter = [&](std::size_t i) { return errors[i].relative.sum() * regions_[i].taken; };
    double all = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) all += scatter(i);
    const bool known = all > 0 && std::isfinite(all);
    const double mean = known ? all / all_pixels_ : 1;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const std::size_t other = other_half(i);
        const double own = known && goal_.adaptive ? scatter(other) / regions_[other].pixels : mean;
        regions_[i].scatter = regions_[i].pixels * (own + prior * (mean - own));
    }
}

bool Passes::error_reached() const {
    if (goal_.error <= 0 || !enough_known()) return false;
    if (error_.relative.value == 0) return total_ >= noiseless_samples;
    return error_.relative.value <= goal_.error && error_.relative.high <= tolerance * goal_.error;
}

std::optional<StopReason> Passes::reached(double elapsed) const {
    if (error_reached()) return StopReason::error;
    const double time_left = goal_.seconds - elapsed;
    if (goal_.seconds > 0 && count_ > 0 && time_left < worth_starting * goal_.seconds) return StopReason::time;
    if (most_samples() >= most_samples_ever) return StopReason::samples;
    return std::nullopt;
}

/// What allocate() should leave of the regions' scatter so that the error is what was asked and its interval, as wide
/// in proportion as now, no wider than tolerated. 0 where no error is asked or none is known.
double Passes::target() const {
    const RootMeanSquare& now = error_.relative;
    if (goal_.error <= 0 || now.value <= 0 || !std::isfinite(now.high)) return 0;
    const double error = aim * goal_.error * std::min(1.0, tolerance * now.value / now.high);
    return left_ * error * error / (now.value * now.value);
}

double Passes::ceiling() const {
    return goal_.samples > 0 ? static_cast<double>(goal_.samples) * all_pixels_
                             : std::numeric_limits<double>::infinity();
}

/// What there is room for, over pixels: the ceiling or what that share of the time left is enough for.
double Passes::room(double elapsed, double share_of_time) const {
    if (goal_.seconds <= 0 || count_ == 0) return ceiling();
    return std::min(ceiling(), total_ + rate_ * share_of_time * (goal_.seconds - elapsed));
}

/// Share of the samples, spread evenly, that the error asked needs if the squared error falls as their number does; 1
/// where no error is asked or none is known.
double Passes::share_of_needed(double total) const {
    if (target() <= 0) return 1;
    const auto needed = allocate(regions_, target(), std::numeric_limits<double>::infinity());
    return std::min(total / total_samples(regions_, needed), 1.0);
}

/// As much again as all before: few barriers and fine strata, and never far beyond what is needed. Far from the error
/// asked, a power of two of that at once, as learning the error takes time, too: no more than the pilot's part of what
/// is needed, and than what is enough along edges, where the squared error may fall as n^-1.5. The first pass is the
/// least that tells an error where time is short.
double Passes::total_of_next() const {
    if (count_ == 0) return (goal_.seconds > 0 ? 2 : 8) * all_pixels_;
    const double done = share_of_needed(total_);
    const double times = std::min(pilot_share / done, std::pow(done, -2.0 / 3));
    return total_ * std::exp2(std::max(1.0, std::floor(std::log2(times))));
}

/// What is done when `total` samples are taken at `elapsed`, by whatever will stop the render first.
double Passes::share(double total, double elapsed) const {
    double share = total / ceiling();
    if (goal_.seconds > 0) share = std::max(share, elapsed / goal_.seconds);
    if (target() > 0) share = std::max(share, share_of_needed(total));
    return std::min(share, 1.0);
}

Pattern Passes::pattern(std::size_t region, double samples, bool keep_below) const {
    const auto whole = [&](double x) { return static_cast<std::uint32_t>(keep_below ? x + 1e-9 : std::round(x)); };
    const double pairs = std::max(samples, 0.0) / 2;
    return stratified_ ? Pattern{whole(std::sqrt(pairs)), 2, taken_[region]}
                       : Pattern{1, 2 * whole(pairs), taken_[region]};
}

/// Samples, over pixels.
double Passes::size(const std::vector<Pattern>& pass) const {
    double sum = 0;
    for (std::size_t i = 0; i < pass.size(); ++i) sum += regions_[i].pixels * pass[i].samples();
    return sum;
}

/// What is wanted, by region, as near as strata allow. To round down is for a limit: else it would leave ever
/// smaller rests.
std::vector<Pattern> Passes::patterns(const std::vector<double>& wanted, bool keep_below) const {
    if (doubling_) return doublings(wanted, keep_below);
    std::vector<Pattern> list;
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        list.push_back(pattern(i, wanted[i] - regions_[i].taken, keep_below));
    return list;
}

/// The same in powers of two. What a region wants and does not get, or has and does not want, goes to the next one of
/// its colour: to one of the other colour it would tell what that colour's own samples asked for.
std::vector<Pattern> Passes::doublings(const std::vector<double>& wanted, bool keep_below) const {
    std::vector<Pattern> list;
    double owed[2] = {0, 0};
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
        std::uint32_t added = taken_[i];
        if (added == 0) {
            const double power = std::log2(std::max(wanted[i], 1.0));
            added = 1u << static_cast<std::uint32_t>(keep_below ? power : std::round(power));
        } else {
            double& due = owed[tiles_[i].colour == Colour::black ? 0 : 1];
            const double cost = regions_[i].pixels * added;
            due += regions_[i].pixels * (wanted[i] - added);
            if (due < (keep_below ? cost : cost / 2)) added = 0;
            due -= regions_[i].pixels * added;
        }
        list.push_back({1, added, taken_[i]});
    }
    return list;
}

/// The least that brings an image further, where what was wanted rounded to nothing; nothing if there is no room.
std::vector<Pattern> Passes::smallest(const std::vector<double>& wanted, double limit) const {
    std::vector<Pattern> list(tiles_.size());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = {1, 0, taken_[i]};
    if (doubling_ && count_ > 0) {
        const auto wish = [&](std::size_t i) { return wanted[i] / regions_[i].taken; };
        std::size_t first = 0;
        for (std::size_t i = 1; i < list.size(); ++i)
            if (wish(i) > wish(first)) first = i;
        if (total_ + regions_[first].pixels * taken_[first] <= limit) list[first].visits = taken_[first];
        return list;
    }
    // All alike: the least that tells an error. A ceiling of one sample leaves nothing to tell.
    const bool room_for_two = total_ + 2 * all_pixels_ <= limit;
    if (!room_for_two && count_ > 0) return list;
    for (Pattern& pattern : list) pattern.visits = room_for_two ? 2 : 1;
    return list;
}

/// Samples per pixel by region after the next pass, of `limit` in all.
std::vector<double> Passes::wanted(double limit) const {
    if (in_pilot_) return std::vector<double>(regions_.size(), limit / all_pixels_);
    std::vector<double> samples = allocate(regions_, target(), limit);
    // Stratified, an edge's error falls faster than foretold: no more than twice as many before the next look.
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = std::min(samples[i], 2 * regions_[i].taken);
    return samples;
}

bool Passes::next(double elapsed, FilmState& state) {
    if (count_ > 0) rate_ = added_ / std::max(elapsed - started_, 1e-6);
    if (const auto reason = reached(elapsed)) {
        reason_ = *reason;
        return false;
    }
    if (enough_known() && share(total_, elapsed) >= pilot_share) in_pilot_ = false;
    const double limit = room(elapsed, time_to_plan);
    const std::vector<double> samples = wanted(std::min(limit, total_of_next()));
    std::vector<Pattern> pass = patterns(samples, false);
    if (total_ + size(pass) > limit) pass = patterns(samples, true);
    // The time left is of no other use: no matter if that pass is lost.
    if (size(pass) == 0) pass = smallest(samples, room(elapsed, 1));
    if (size(pass) == 0) {
        reason_ = limit < ceiling() ? StopReason::time : StopReason::samples;
        return false;
    }
    begin(pass, elapsed, state);
    return true;
}

void Passes::begin(const std::vector<Pattern>& pass, double elapsed, FilmState& state) {
    share_before_ = share(total_, elapsed);
    added_ = size(pass);
    for (std::size_t i = 0; i < pass.size(); ++i) {
        FilmRegion& region = state.regions[i];
        region.strata = std::max(pass[i].strata, 1u);
        region.visits = pass[i].samples() > 0 ? pass[i].visits : 0;
        region.scatter = regions_[i].scatter;
        taken_[i] += pass[i].samples();
        regions_[i].taken = taken_[i];
    }
    total_ += added_;
    share_after_ = share(total_, rate_ > 0 ? elapsed + added_ / rate_ : elapsed);
    started_ = elapsed;
    state.passes = ++count_;
    state.pilot = in_pilot_;
    state.share_before = share_before_;
    state.share_after = share_after_;
}

}  // namespace orrery
