// Inlining that must happen: a helper compiled once per instruction set must never become a function the linker could
// share between them.
#pragma once

#define ORRERY_INLINE [[gnu::always_inline]] inline

/// The same for a lambda, between its parameters and its body.
#define ORRERY_INLINE_LAMBDA __attribute__((always_inline))
