#include "system/links.hpp"

#include <linux/magic.h>
#include <sys/vfs.h>

namespace orrery {

namespace fs = std::filesystem;

fs::path follow_links(const fs::path& file, std::error_code& error) {
    constexpr int longest_chain = 40;  // as the kernel allows
    fs::path target = file;
    for (int links = 0; links < longest_chain; ++links) {
        error.clear();
        std::error_code none;  // what is not there is no link
        if (!fs::is_symlink(fs::symlink_status(target, none))) return target;
        struct statfs system = {};
        if (::statfs(folder_of(target).c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC) {
            error = std::make_error_code(std::errc::no_such_device_or_address);
            return target;
        }
        const fs::path next = fs::read_symlink(target, error);
        if (error) return target;
        target = target.parent_path() / next;  // an absolute `next` replaces all
    }
    error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    return target;
}

bool means_open_file(const fs::path& file) {
    std::error_code error;
    follow_links(file, error);
    return error == std::errc::no_such_device_or_address;
}

}  // namespace orrery
