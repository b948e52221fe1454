# Fails if an object file compiled for AVX2 or AVX-512 defines a symbol that another object file could define as well.
#
# Of several definitions of an inline function the linker keeps one, for every caller: were it the one compiled with
# -mavx512f, the program would die on a machine without AVX-512 in code that never asked for it. So whatever such an
# object shows the linker must name the instruction set it is for: a template on xsimd's architecture does.
#
# Run as: cmake -DNM=... -DOBJECTS=a.o;b.o -P check_symbols.cmake
set(mark_avx2 "xsimd::fma3<xsimd::avx2>")
set(mark_avx512 "xsimd::avx512dq")

# Not shared code:
# - the table itself is unique to its file;
# - DW.ref.__gxx_personality_v0 is a pointer the unwinder reads, the same data in every object;
# - detail::compress_table and detail::iota_table are constants: data, the same bytes whoever defines them.
set(exceptions "^(orrery::kernels::(avx2|avx512)_stages(_double)?|DW\\.ref\\.__gxx_personality_v0|orrery::kernels::detail::(compress_table<.*>|iota_table<(float|double)>))$")

set(checked 0)
set(faults "")
foreach(object IN LISTS OBJECTS)
  if(NOT object MATCHES "isa/(avx2|avx512)(_double)?\\.cpp")
    continue()
  endif()
  set(isa ${CMAKE_MATCH_1})
  execute_process(COMMAND ${NM} -C --defined-only --extern-only ${object}
                  OUTPUT_VARIABLE listing RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "nm cannot read ${object}")
  endif()
  string(REPLACE ";" "," listing "${listing}")
  string(REPLACE "[" "(" listing "${listing}")  # brackets group list items in CMake
  string(REPLACE "]" ")" listing "${listing}")
  string(REPLACE "\n" ";" lines "${listing}")
  set(own 0)
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^[0-9a-fA-F]* +([A-Za-z]) (.+)$")
      continue()
    endif()
    set(name "${CMAKE_MATCH_2}")
    string(FIND "${name}" "${mark_${isa}}" at)
    if(NOT at EQUAL -1)
      math(EXPR own "${own} + 1")
    elseif(NOT name MATCHES "${exceptions}")
      string(APPEND faults "\n  ${object}: ${name}")
    endif()
  endforeach()
  if(own LESS 20)  # a table has more stages than that: the check would be looking at the wrong thing
    string(APPEND faults "\n  ${object}: only ${own} functions name ${mark_${isa}}")
  endif()
  math(EXPR checked "${checked} + 1")
endforeach()
if(NOT checked EQUAL 4)
  message(FATAL_ERROR "expected the four objects of AVX2 and AVX-512 among: ${OBJECTS}")
endif()
if(faults)
  message(FATAL_ERROR "code the linker may hand to callers on other machines:${faults}")
endif()
