# Sets XSIMD_INCLUDE_DIR, or appends xsimd to `missing`.
#
# The headers are looked for themselves, as Debian's CMake package of xsimd 8.1 links a library `xtl` that it does not
# depend on. Before 8.0 vectors had other types altogether; from 14.0 on min and max treat what is no number otherwise,
# on which the kernels rely (lanes/numbers.hpp).
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp)
if(XSIMD_INCLUDE_DIR)
  set(xsimd_version "")
  if(EXISTS ${XSIMD_INCLUDE_DIR}/xsimd/config/xsimd_config.hpp)
    file(STRINGS ${XSIMD_INCLUDE_DIR}/xsimd/config/xsimd_config.hpp parts REGEX "define XSIMD_VERSION_(MAJOR|MINOR|PATCH) ")
    string(REGEX MATCHALL "[0-9]+" parts "${parts}")
    list(JOIN parts "." xsimd_version)
  endif()
  if(xsimd_version VERSION_GREATER_EQUAL 8.1 AND xsimd_version VERSION_LESS 14)
    message(STATUS "Found xsimd ${xsimd_version}: ${XSIMD_INCLUDE_DIR}")
    return()
  endif()
  set(xsimd_found ", not the ${xsimd_version} in ${XSIMD_INCLUDE_DIR}")
  unset(XSIMD_INCLUDE_DIR CACHE)  # so that another is looked for next time
endif()
list(APPEND missing "xsimd (8.1 to 13${xsimd_found})")
