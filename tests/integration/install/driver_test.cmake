# A driver that is written elsewhere: the example, built by the C compiler from the installed header alone, found and tried.
#   cmake -DBUILD=<build folder> -DWORK=<folder to work in> -DEXAMPLE=<driver_still.c> -P driver_test.cmake
file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
file(COPY_FILE "${EXAMPLE}" "${WORK}/still.c")
set(ENV{MECHANE_DRIVERS} "${WORK}")
foreach(step
    "${CMAKE_COMMAND};--install;${BUILD};--component;drivers;--prefix;${WORK}/prefix"
    "cc;-std=c11;-Wall;-Wextra;-Werror;-shared;-fPIC;-I;${WORK}/prefix/include;still.c;-o;mechane_driver_still.so"
    "${BUILD}/bin/mechane;devices"
    "${BUILD}/bin/mechane;devices;--test;still:height=0.25;--seconds;0.5;--json")
  execute_process(COMMAND ${step} WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE faults)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${step}\n${said}${faults}")
  endif()
endforeach()
string(JSON condition GET "${said}" condition)
string(JSON ticks GET "${said}" ticks)
if(NOT condition STREQUAL "ready" OR ticks LESS 50)
  message(FATAL_ERROR "${said}")
endif()
