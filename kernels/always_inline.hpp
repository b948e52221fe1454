// Inlining that must happen: a helper compiled once per instruction set must never become a function the linker could
// share between them.
#pragma once

#define ORRERY_INLINE [[gnu::always_inline]] inline
