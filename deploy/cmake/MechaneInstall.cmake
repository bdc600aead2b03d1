# The collision library for other projects: `cmake --install build/release --component collision`, then find_package(mechane-collision).
# It needs Eigen and tl::expected to be used, and nothing else.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(rooms base geometry collision collision_build)
foreach(room IN LISTS rooms)
  # The headers name each other from the repository's root, so they keep their folders.
  install(DIRECTORY "${CMAKE_SOURCE_DIR}/server/${room}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/mechane/server"
          COMPONENT collision FILES_MATCHING PATTERN "*.hpp" PATTERN "kernel_body.hpp" EXCLUDE)
  set_target_properties(mechane_${room} PROPERTIES EXPORT_NAME ${room})
endforeach()
target_compile_features(mechane_base INTERFACE cxx_std_20)
# Eigen aligns by the instruction set that it is compiled for. Whoever takes the library with -march=native must have its layout.
target_compile_definitions(mechane_base INTERFACE $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=16>)
install(TARGETS mechane_base mechane_geometry mechane_collision mechane_collision_build EXPORT mechane-collision
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT collision
        INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/mechane")

set(config_folder "${CMAKE_INSTALL_LIBDIR}/cmake/mechane-collision")
install(EXPORT mechane-collision NAMESPACE mechane:: DESTINATION "${config_folder}" FILE mechane-collision-targets.cmake
        COMPONENT collision)
file(WRITE "${CMAKE_BINARY_DIR}/mechane-collision-config.cmake" [=[
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(tl-expected)
find_dependency(Threads)
include("${CMAKE_CURRENT_LIST_DIR}/mechane-collision-targets.cmake")
]=])
write_basic_package_version_file("${CMAKE_BINARY_DIR}/mechane-collision-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/mechane-collision-config.cmake"
              "${CMAKE_BINARY_DIR}/mechane-collision-config-version.cmake"
        DESTINATION "${config_folder}" COMPONENT collision)
