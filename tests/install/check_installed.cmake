# Installs BUILD_DIR below WORK_DIR, builds CONSUMER_DIR against it and runs what comes out.
file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)
set(loud COMMAND_ERROR_IS_FATAL ANY)

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} ${loud})
execute_process(COMMAND ${prefix}/bin/boxwood --version ${loud})
execute_process(COMMAND ${CONFIGURE} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build
  -DCMAKE_PREFIX_PATH=${prefix} ${loud})
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build ${loud})
execute_process(COMMAND ${WORK_DIR}/build/consumer OUTPUT_VARIABLE said ${loud})
if(NOT said STREQUAL "1 triangle, hit at 1\n")
  message(FATAL_ERROR "the consumer said '${said}'")
endif()
