#include "bench/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace orrery::bench {

namespace {

constexpr double width = 760, height = 420, left = 64, right = 190, top = 40, bottom = 56;
constexpr double plot_width = width - left - right, plot_height = height - top - bottom;

/// Mid tones that stand out on white and on near-black alike.
constexpr const char* palette[] = {"#d9822b", "#3d8fd1", "#3aa35f", "#c2508f",
                                   "#8a6fd1", "#b59a1b", "#d1553d", "#3aa3a3"};

const char* colour(std::size_t i) { return palette[i % std::size(palette)]; }

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

std::string text(double x, double y, const char* anchor, const std::string& content, const char* more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more,
                       escaped(content));
}

/// Everything but the data: no background, so that the page's shows; lines and text of the page's own colour where the
/// viewer tells light from dark.
std::string frame(const std::string& title, const std::string& y_label) {
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" "
        "font-size=\"13\">\n"
        "<style>text{{fill:#444}}.grid{{stroke:#888;stroke-opacity:.35}}.title{{font-size:15px;font-weight:bold}}"
        "@media(prefers-color-scheme:dark){{text{{fill:#ccc}}}}</style>\n",
        width, height);
    svg += text(left, 22, "start", title, " class=\"title\"");
    svg += text(14, top + plot_height / 2, "middle", y_label,
                fmt::format(" transform=\"rotate(-90 14 {:.1f})\"", top + plot_height / 2).c_str());
    return svg;
}

double y_of(const Axis& axis, double value) { return top + plot_height * (1 - axis.place(value)); }

std::string horizontal_grid(const Axis& axis) {
    std::string svg;
    for (const double tick : axis.ticks()) {
        const double y = y_of(axis, tick);
        svg += fmt::format("<line class=\"grid\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n", left,
                           left + plot_width, y);
        svg += text(left - 6, y + 4, "end", short_number(tick));
    }
    return svg;
}

std::string legend(const std::vector<Series>& series) {
    std::string svg;
    double y = top + 6;
    for (const Series& s : series) {
        const double x = left + plot_width + 14;
        svg += fmt::format(
            "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"3\"{}/>\n", x,
            x + 22, y, y, colour(s.colour), s.dashed ? " stroke-dasharray=\"5 3\"" : "");
        svg += text(x + 28, y + 4, "start", s.name);
        y += 20;
    }
    return svg;
}

struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

}  // namespace

std::string svg_of(const LinePlot& plot) {
    Extent xs, ys;
    for (const Series& s : plot.series)
        for (const auto& [x, y] : s.points) xs.add(x), ys.add(y);
    std::string svg = frame(plot.title, plot.y_label);
    if (ys.high > 0) {
        const Axis x_axis(xs.low, xs.high, true), y_axis(ys.low, ys.high, true);
        const auto x_of = [&](double x) { return left + plot_width * x_axis.place(x); };
        svg += horizontal_grid(y_axis);
        for (const double tick : x_axis.ticks()) {
            // Every tick would be a crowd: powers of ten only.
            const std::string label = short_number(tick);
            if (label.front() == '1' && label.find_first_not_of("10kMG.") == std::string::npos)
                svg += text(x_of(tick), top + plot_height + 20, "middle", label);
        }
        svg += text(left + plot_width / 2, height - 14, "middle", plot.x_label);
        for (const Series& s : plot.series) {
            std::string path;
            for (const auto& [x, y] : s.points)
                path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_of(x), y_of(y_axis, y));
            svg += fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"{} d=\"{}\"/>\n",
                               colour(s.colour), s.dashed ? " stroke-dasharray=\"6 4\"" : "", path);
            for (const auto& [x, y] : s.points)
                svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x_of(x),
                                   y_of(y_axis, y), colour(s.colour));
        }
        svg += legend(plot.series);
    }
    return svg + "</svg>\n";
}

std::string svg_of(const BarPlot& plot) {
    Extent ys;
    for (const auto& group : plot.values)
        for (const double value : group)
            if (value > 0) ys.add(value);
    std::string svg = frame(plot.title, plot.y_label);
    if (ys.high > 0 && !plot.groups.empty()) {
        const Axis axis(plot.logarithmic ? ys.low * 0.8 : 0, ys.high, plot.logarithmic);
        svg += horizontal_grid(axis);
        const double slot = plot_width / static_cast<double>(plot.groups.size());
        const double bar = slot * 0.8 / static_cast<double>(plot.series.size());
        for (std::size_t g = 0; g < plot.groups.size(); ++g) {
            const double start = left + slot * (static_cast<double>(g) + 0.1);
            for (std::size_t s = 0; s < plot.values[g].size(); ++s) {
                if (!(plot.values[g][s] > 0)) continue;
                const double y = y_of(axis, plot.values[g][s]);
                svg += fmt::format(
                    "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"><title>{} {}: "
                    "{}</title></rect>\n",
                    start + bar * static_cast<double>(s), y, bar * 0.92, top + plot_height - y, colour(s),
                    escaped(plot.groups[g]), escaped(plot.series[s]), short_number(plot.values[g][s]));
            }
            const double x = start + slot * 0.4, y = top + plot_height + 14;
            svg += text(x, y, "end", plot.groups[g],
                        fmt::format(" font-size=\"11\" transform=\"rotate(-22 {:.1f} {:.1f})\"", x, y).c_str());
        }
        std::vector<Series> names;
        for (std::size_t s = 0; s < plot.series.size(); ++s) names.push_back({plot.series[s], {}, false, s});
        svg += legend(names);
    }
    return svg + "</svg>\n";
}

}  // namespace orrery::bench
