#include "image/png_fault.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

namespace orrery {

void PngFault::on_error(png_structp png, png_const_charp message) {
    auto* const fault = static_cast<PngFault*>(png_get_error_ptr(png));
    std::strncpy(fault->message_, message, sizeof fault->message_ - 1);
    png_longjmp(png, 1);
}

void PngFault::raise() const { throw std::runtime_error(std::string("libpng: ") + message_); }

}  // namespace orrery
