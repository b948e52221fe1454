#include "cli/images.hpp"

#include <fmt/format.h>

#include <new>

#include "cli/process.hpp"
#include "scene/settings.hpp"

namespace orrery {

std::vector<std::filesystem::path> write_images(const Outputs& outputs, const Image& image, const Image& standard_error,
                                                const Making& making) {
    const Loss loss("orrery: interrupted: images that were not written yet are lost\n");
    std::vector<std::filesystem::path> written;
    const auto write = [&](const std::filesystem::path& file, const Image& pixels, const Making& made) {
        try {
            write_image(file, pixels, Look(tone_mapper(made.settings), made.exposure),
                        image_metadata(made, image_format(file)));
            written.push_back(file);
        } catch (const std::bad_alloc&) {
            print_error(fmt::format("{}: out of memory", file.string()));
        } catch (const std::runtime_error& fault) {
            print_error(fault.what());
        }
    };
    for (const auto& file : outputs.images) write(file, image, making);
    if (outputs.error_image) {
        Making of_errors = making;
        of_errors.content = "standard error";
        write(*outputs.error_image, standard_error, of_errors);
    }
    return written;
}

}  // namespace orrery
