# What another project's CMakeLists.txt looks like.
cmake_minimum_required(VERSION 3.25)
project(touch LANGUAGES CXX)
find_package(mechane-collision 0.1 REQUIRED)
foreach(example touch contacts)
  add_executable(${example} ${example}.cpp)
  target_link_libraries(${example} PRIVATE mechane::collision)
endforeach()
