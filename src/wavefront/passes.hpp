// A render in passes: which samples come next, and when there are enough.
//
// Decisions fall between passes, from the film alone (and from the clock, where a time is asked), so that they are the
// same for any number of threads and any wave size. A pass goes through a pixel's grid of cells twice: the two samples
// of a cell tell its error without bias, stratified as it is. Its samples have numbers no pass before had.
//
// Adaptive sampling without bias. Were the samples of a pixel to decide how many more it gets, one that missed a rare
// bright path would look quiet and stay dark, one that caught it would be diluted: the mean sinks. So the pixels of a
// tile are two halves, like the fields of a chess board, and each half gets what the error of the *other* half asks
// for. Neighbouring pixels need about the same and share no random number. And nothing that adaptive samples show is
// asked again: a half that got more of them sees more, and would pass on to the other what that had passed to it. The
// first passes, an eighth of the work or more, give all pixels as many samples; after these only the error of the whole
// image counts, in which a pixel is one of many.
//
// Sobol's sequences go on from pass to pass, both by as many points. They are even after powers of two of them, and
// less so after a few more (an edge's error is four times as large after 34 samples as after 32), so that where regions
// may differ each one's samples double or stay, and of regions that want half as many again every second one doubles.
#pragma once

#include <optional>
#include <vector>

#include "film/error.hpp"
#include "film/film_state.hpp"
#include "wavefront/allocation.hpp"
#include "wavefront/goal.hpp"
#include "wavefront/pattern.hpp"

namespace orrery {

class Passes {
public:
    /// How regions are laid out.
    static FilmState layout();

    /// Goes on where `state`, of that layout, is: in a pass, whose error is to be learnt next, or before the first.
    Passes(const Plan& plan, const Goal& goal, const FilmState& state);

    /// Asks the next pass of `state`, which has all that was asked before, `elapsed` seconds after the start; false
    /// when enough is done. All of it is to be rendered, and the error to be learnt, before the next call.
    bool next(double elapsed, FilmState& state);

    /// What parts of the image are told apart, and how large the error of each is now.
    const std::vector<Tile>& regions() const { return tiles_; }
    void learn(const std::vector<ErrorSums>& errors);

    const ImageError& error() const { return error_; }
    StopReason reason() const { return reason_; }
    void stop(StopReason reason) { reason_ = reason; }  ///< for a reason that only the caller knows
    /// Share of the work, in [0, 1], that is done before the present pass and with it, as far as can be told.
    double share_before() const { return share_before_; }
    double share_after() const { return share_after_; }

    std::uint32_t count() const { return count_; }                ///< passes begun
    double mean_samples() const { return total_ / all_pixels_; }  ///< per pixel
    std::uint32_t least_samples() const;
    std::uint32_t most_samples() const;

private:
    void learn_scatter(const std::vector<ErrorSums>& errors);
    std::size_t other_half(std::size_t region) const;
    bool enough_known() const;
    bool error_reached() const;
    std::optional<StopReason> reached(double elapsed) const;
    double target() const;
    std::vector<double> wanted(double limit) const;
    double ceiling() const;
    double room(double elapsed, double share_of_time) const;
    double share_of_needed(double total) const;
    double total_of_next() const;
    double share(double total, double elapsed) const;
    Pattern pattern(std::size_t region, double samples, bool keep_below) const;
    double size(const std::vector<Pattern>& pass) const;
    std::vector<Pattern> patterns(const std::vector<double>& wanted, bool keep_below) const;
    std::vector<Pattern> doublings(const std::vector<double>& wanted, bool keep_below) const;
    std::vector<Pattern> smallest(const std::vector<double>& wanted, double limit) const;
    void begin(const std::vector<Pattern>& pass, double elapsed, FilmState& state);

    Goal goal_;
    bool stratified_;
    bool doubling_;            ///< a region's samples double or stay as they are
    std::vector<Tile> tiles_;  ///< by region; the halves of a tile stand side by side
    std::vector<Region> regions_;
    std::vector<std::uint32_t> taken_;  ///< by region, as a sample number
    double all_pixels_ = 0;
    double total_ = 0;    ///< samples taken, over pixels
    double rate_ = 0;     ///< samples per second in the last pass
    double added_ = 0;    ///< samples of the last pass
    double started_ = 0;  ///< seconds, the last pass
    ImageError error_;
    double doubt_ = 0;  ///< share of it
    double left_ = 0;   ///< of the regions' scatter at that error, as allocate() counts it
    std::uint32_t count_ = 0;
    bool in_pilot_ = true;
    StopReason reason_ = StopReason::samples;
    double share_before_ = 0, share_after_ = 0;
};

}  // namespace orrery
