# Compiler options that hold for every target, and the third-party libraries, found once.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

# Dev (its flags are in CMakePresets.json: project() has made them empty cache entries by now): fast enough to run the loop,
# assertions on. Release keeps debug symbols apart from speed, and keeps MECHANE_ASSERT.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -g1 -DNDEBUG" CACHE STRING "" FORCE)

find_program(CCACHE ccache)
if(CCACHE)
  # Paths are hashed relative to the checkout, so that another clone on the same machine finds what this one compiled.
  set(launcher "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}" CCACHE_NOHASHDIR=1
      CCACHE_PCH_EXTSUM=1 CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
endif()

# __FILE__ begins at the root of the repository: messages name no folder of a machine, and ccache finds what another clone compiled.
add_compile_options("-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=")

# Same inputs, same bits: no contraction into fused multiply-adds but where a kernel asks for one by name.
add_compile_options(-ffp-contract=off)
add_link_options(-fuse-ld=lld)

if(MECHANE_SANITIZE)
  add_compile_options(-fsanitize=${MECHANE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${MECHANE_SANITIZE})
  # With checks in them, Eigen's many small functions seem too large to be inlined: a sanitized build is several times slower then.
  add_compile_definitions("EIGEN_STRONG_INLINE=inline __attribute__((always_inline))")
  if(MECHANE_SANITIZE MATCHES "undefined")
    # What the address sanitizer stops at anyway; with them a third more is compiled, and tests take twice as long.
    add_compile_options(-fno-sanitize=null,object-size,pointer-overflow)
  endif()
  if(MECHANE_SANITIZE MATCHES "thread")
    # std::atomic_thread_fence is not modelled by the thread sanitizer; our structures use ordered atomics instead.
    add_compile_options(-Wno-tsan)
  endif()
endif()

if(CMAKE_UNITY_BUILD)
  # Several sources in one: a class in a .cpp file looks as if a header had it.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage> -Wno-unknown-warning-option)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_BUILD_TYPE STREQUAL "Dev")
  # GCC 12 at -O1 suspects the standard library's own strings and optionals.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-array-bounds>)
endif()

set(MECHANE_WARNINGS
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  -Wcast-align -Wformat=2 -Wimplicit-fallthrough -Werror)

find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(CycloneDDS 0.10.2 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tl-expected REQUIRED)
find_package(SQLiteCpp REQUIRED)
find_package(meshoptimizer REQUIRED)
pkg_check_modules(BULLET REQUIRED IMPORTED_TARGET bullet-float64)
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp)
pkg_check_modules(EXPAT REQUIRED IMPORTED_TARGET expat)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(SYSTEMD REQUIRED IMPORTED_TARGET libsystemd)
pkg_check_modules(TOMLPP REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(SDL2 REQUIRED IMPORTED_TARGET sdl2)
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(FREETYPE REQUIRED IMPORTED_TARGET freetype2)
pkg_check_modules(HARFBUZZ REQUIRED IMPORTED_TARGET harfbuzz)
pkg_check_modules(OPENSSL REQUIRED IMPORTED_TARGET openssl)
pkg_check_modules(SODIUM REQUIRED IMPORTED_TARGET libsodium)
pkg_check_modules(CURL REQUIRED IMPORTED_TARGET libcurl>=7.87)
pkg_check_modules(OPENAL REQUIRED IMPORTED_TARGET openal)
pkg_check_modules(SNDFILE REQUIRED IMPORTED_TARGET sndfile)
pkg_check_modules(QRENCODE REQUIRED IMPORTED_TARGET libqrencode)
