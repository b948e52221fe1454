// What hangs in the gallery.
#pragma once

#include <span>
#include <string_view>

namespace orrery {

/// One picture, made by `orrery render` with these words; the page shows them, so that anyone can repeat it.
struct GalleryEntry {
    std::string_view section;  ///< the heading it stands under
    std::string_view caption;
    std::string_view file;       ///< in output/
    std::string_view arguments;  ///< a scene in scenes/ and options
};

/// In the order of the page; entries of one section stand together.
std::span<const GalleryEntry> gallery();

}  // namespace orrery
