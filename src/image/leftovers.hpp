// Temporaries of writers that were killed, and how to tell them from those of writers at work.
//
// A writer holds a lock (flock) on its temporary until it is renamed; the system lets go of it when the process ends,
// however it ends. What nobody holds is left over. On a file system of many machines the lock may hold on each alone:
// what another one made, as the name says, must also be a day old.
#pragma once

#include <filesystem>
#include <string>

namespace orrery {

/// A name for a temporary, ".orrery-MACHINE-PROCESS-N.tmp", another one at each call. It is short and does not repeat
/// the target's: that one may be as long as the file system allows.
std::string temporary_name();

/// Takes the lock of a temporary just made, for as long as the descriptor or a duplicate of it is open. False where
/// somebody who removes leftovers was quicker: the file is gone then, or will be.
bool lock_temporary(int descriptor);

/// Removes what is left over in the folder, as far as that is allowed.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace orrery
