# Runs what follows "--" in a folder of its own. What it wrote is what the program in C wrote, whose own
# answer is that a fifth of the cells is left.
cmake_minimum_required(VERSION 3.25)

set(command "")
set(is_command FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  if(is_command)
    list(APPEND command "${CMAKE_ARGV${i}}")
  elseif(CMAKE_ARGV${i} STREQUAL "--")
    set(is_command TRUE)
  endif()
endforeach()

set(folder ${WORK}/${NAME})
file(REMOVE_RECURSE ${folder})
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${command} WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE words
  COMMAND_ECHO STDOUT ECHO_OUTPUT_VARIABLE COMMAND_ERROR_IS_FATAL ANY)

set(kinds tets raw)
if(NAME STREQUAL "command")
  set(kinds tets)
endif()
foreach(kind IN LISTS kinds)
  set(made ${folder}/${NAME}.${kind})
  file(SIZE ${made} size)
  if(size LESS 10000)
    message(SEND_ERROR "${made} has only ${size} bytes")
  endif()
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${made} ${WORK}/c/c.${kind}
    RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "${made} is not the answer of the program in C")
  endif()
endforeach()
# Reached: never above, and at most 10 cells below.
if(NAME STREQUAL "c" AND NOT words MATCHES "C: 20(6[3-9]|7[0-3]) cells, ratio")
  message(SEND_ERROR "2073 of 10368 cells were asked for: ${words}")
endif()
