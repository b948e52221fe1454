// libpng reports errors by longjmp, which must not pass a C++ destructor. Here is the one place that calls setjmp.
#pragma once

#include <png.h>

#include <csetjmp>
#include <type_traits>

namespace orrery {

/// The error handlers of a libpng struct: the reason is kept, the work given up.
class PngFault {
public:
    /// To be given to png_create_*_struct, with the PngFault as the error pointer.
    [[noreturn]] static void on_error(png_structp png, png_const_charp message);
    /// Warnings concern what is repaired or not used; a library does not write to standard error.
    static void on_warning(png_structp, png_const_charp) {}

    /// Runs `work`, which calls libpng; throws std::runtime_error where libpng gave up. Between setjmp and longjmp no
    /// object with a destructor may come to life, so what `work` needs is made before and captured by reference.
    template <typename Work>
    void guard(png_structp png, const Work& work) {
        static_assert(std::is_trivially_destructible_v<Work>);
        if (setjmp(png_jmpbuf(png)) != 0) raise();
        work();
    }

private:
    [[noreturn]] void raise() const;

    char message_[128] = {};  // not a std::string: on_error is left by longjmp
};

}  // namespace orrery
