# Installs the collision library into an empty folder, and builds and runs a project that uses it from there: as it is, and for this
# machine's own instructions, with which Eigen would lay its types out in another way.
#   cmake -DBUILD=<build folder> -DWORK=<folder to work in> -P install_test.cmake
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}/project")
file(COPY_FILE "${CMAKE_CURRENT_LIST_DIR}/consumer.cmake" "${WORK}/project/CMakeLists.txt")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/touch.cpp" "${CMAKE_CURRENT_LIST_DIR}/contacts.cpp" DESTINATION "${WORK}/project")
foreach(step
    "${CMAKE_COMMAND};--install;${BUILD};--component;collision;--prefix;${WORK}/prefix"
    "${CMAKE_COMMAND};-S;${WORK}/project;-B;${WORK}/build;-DCMAKE_BUILD_TYPE=Release;-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    "${CMAKE_COMMAND};--build;${WORK}/build"
    "${WORK}/build/touch"
    "${WORK}/build/contacts;ball.part"
    "${CMAKE_COMMAND};-S;${WORK}/project;-B;${WORK}/native;-DCMAKE_BUILD_TYPE=Release;-DCMAKE_PREFIX_PATH=${WORK}/prefix;-DCMAKE_CXX_FLAGS=-march=native"
    "${CMAKE_COMMAND};--build;${WORK}/native"
    "${WORK}/native/touch"
    "${WORK}/native/contacts;ball.part")
  execute_process(COMMAND ${step} WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${step}\n${said}")
  endif()
endforeach()
message("${said}")
