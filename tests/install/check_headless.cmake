# Builds the program of SOURCE_DIR with the viewer off, and looks at what it is linked with.
set(loud COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CONFIGURE} -S ${SOURCE_DIR} -B ${WORK_DIR}
  -DBOXWOOD_VIEWER=OFF -DBOXWOOD_TESTS=OFF ${loud})
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR} --target boxwood ${loud})

execute_process(COMMAND ldd ${WORK_DIR}/boxwood OUTPUT_VARIABLE libraries ${loud})
if(libraries MATCHES "libGL|libEGL|libOpenGL|libglfw|libX11|libwayland|imgui")
  message(FATAL_ERROR "a program without a window links ${CMAKE_MATCH_0}:\n${libraries}")
endif()

execute_process(COMMAND ${WORK_DIR}/boxwood view model.obj
  RESULT_VARIABLE status ERROR_VARIABLE said)
if(NOT status EQUAL 2 OR NOT said MATCHES "built without the window; use boxwood render")
  message(FATAL_ERROR "boxwood view without a viewer: status ${status}, '${said}'")
endif()
