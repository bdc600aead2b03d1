# What another project's CMakeLists.txt looks like.
cmake_minimum_required(VERSION 3.25)
project(touch LANGUAGES CXX)
find_package(mechane-collision 0.1 REQUIRED)
add_executable(touch touch.cpp)
target_link_libraries(touch PRIVATE mechane::collision_build)
add_executable(contacts contacts.cpp)
target_link_libraries(contacts PRIVATE mechane::collision)
