// Any bytes as a scene file: read or refused, with messages fit to print, and what is read renders.
#include <cstdlib>
#include <string_view>

#include "scene/read.hpp"
#include "system/printable.hpp"
#include "wavefront/render.hpp"

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

bool is_printable(const std::string& text) { return orrery::printable(text, text.size() + 1) == text; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace orrery;
    ReadResult result = read_scene_text({reinterpret_cast<const char*>(data), size}, "scene.json");
    bool refused = false;
    for (const Diagnostic& diagnostic : result.diagnostics) {
        refused |= diagnostic.severity == Severity::error;
        require(is_printable(diagnostic.message) && is_printable(diagnostic.where) && !diagnostic.message.empty());
    }
    require(result.scene.has_value() != refused);
    if (!result.scene) return 0;
    RenderSettings& settings = result.scene->settings;
    settings.width = settings.height = 2;
    settings.samples = 1;
    settings.depth = std::min(settings.depth, 6u);
    RenderOptions options;
    options.threads = 1;
    options.wave_size = 32;
    for (const Rgb& pixel : render(Plan(*result.scene), options).image.pixels)
        require(std::isfinite(pixel.r + pixel.g + pixel.b) && std::min({pixel.r, pixel.g, pixel.b}) >= 0);
    return 0;
}
