# The headers that nearly every source reads, parsed once for all targets of the same options.
#   mechane_precompiled(rooms [PROGRAM] [OPTIONS -O0] [HEADERS <more> ...] [LIBS more ...])   makes them
#   mechane_use_precompiled(target rooms)                                                    lets a target read them
# PROGRAM: for programs, which are compiled with -fPIE, and not for libraries.
set(MECHANE_COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <ranges> <span> <sstream> <string>
  <string_view> <thread> <variant> <vector> <Eigen/Dense> <tl/expected.hpp>)

# Precompiled headers name the clone that they were made in. ccache compares a sum of the headers' text instead, so that another clone finds
# what this one has compiled.
function(_mechane_sum_for_ccache target options source)
  get_target_property(eigen Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -std=c++20 "-I${eigen}" -E -P "${source}"
                  OUTPUT_VARIABLE text RESULT_VARIABLE status ERROR_VARIABLE error)
  if(status)
    message(FATAL_ERROR "the headers in ${source} cannot be read: ${error}")
  endif()
  string(SHA256 sum "${text};${options};${MECHANE_SANITIZE};${CMAKE_CXX_COMPILER_VERSION};${CMAKE_BUILD_TYPE}")
  foreach(end gch pch)
    file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/cmake_pch.hxx.${end}.sum" "${sum}")
  endforeach()
endfunction()

function(mechane_precompiled name)
  cmake_parse_arguments(P "PROGRAM" "" "OPTIONS;HEADERS;LIBS" ${ARGN})
  set(target mechane_headers_${name})
  set(headers ${MECHANE_COMMON_HEADERS} ${P_HEADERS})
  set(source "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.cpp")
  list(TRANSFORM headers PREPEND "#include " OUTPUT_VARIABLE lines)
  string(JOIN "\n" text ${lines} "int main() {}" "")
  file(CONFIGURE OUTPUT "${source}" CONTENT "${text}" @ONLY)
  if(CCACHE)
    _mechane_sum_for_ccache(${target} "${P_OPTIONS}" "${source}")
  endif()
  if(P_PROGRAM)
    add_executable(${target} EXCLUDE_FROM_ALL "${source}")
  else()
    add_library(${target} OBJECT EXCLUDE_FROM_ALL "${source}")
  endif()
  target_link_libraries(${target} PRIVATE Eigen3::Eigen tl::expected Threads::Threads ${P_LIBS})
  target_compile_options(${target} PRIVATE ${MECHANE_WARNINGS} ${P_OPTIONS})
  target_precompile_headers(${target} PRIVATE ${headers})
  set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER "" UNITY_BUILD OFF)
endfunction()

function(mechane_use_precompiled target name)
  target_precompile_headers(${target} REUSE_FROM mechane_headers_${name})
  # clang-tidy reads the headers as text, also for a target that links nothing with Eigen.
  target_include_directories(${target} SYSTEM PRIVATE $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
endfunction()
