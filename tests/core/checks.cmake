# What the trajectory's tests need beside cmocka: the twin, the golden scenes, and checks of the sources.
foreach(name trajectory_twin trajectory_ties hard_grazing hard_simultaneous hard_density hard_special)
  target_sources(test_${name} PRIVATE twin.c twin_compare.c)
endforeach()
foreach(name grazing grazing_run simultaneous density long reversal special)
  set_tests_properties(core_hard_${name} PROPERTIES TIMEOUT 300) # events without end would take all memory
endforeach()
target_sources(test_golden PRIVATE golden.c)
if(NOT HDLYAP_SANITIZE)
  hdlyap_core_test(startup)
endif()
foreach(name effects hard_memory startup) # what they see of the core's memory
  if(TARGET test_${name})
    target_sources(test_${name} PRIVATE ledger.c)
    target_compile_definitions(test_${name} PRIVATE _GNU_SOURCE) # RTLD_NEXT
    target_link_libraries(test_${name} PRIVATE ${CMAKE_DL_LIBS})
  endif()
endforeach()

get_filename_component(HDLYAP_CORE_FOLDER ${CMAKE_CURRENT_SOURCE_DIR}/../../hdlyap_core ABSOLUTE)
function(hdlyap_script_test name)
  add_test(NAME core_${name} COMMAND ${CMAKE_COMMAND} -DCORE=${HDLYAP_CORE_FOLDER}
    -DWORK=${CMAKE_CURRENT_BINARY_DIR}/${name} ${ARGN} -P ${CMAKE_CURRENT_SOURCE_DIR}/${name}.cmake)
endfunction()

hdlyap_script_test(includes)
if(NOT HDLYAP_SANITIZE) # they would build the same once more
  hdlyap_script_test(headers -DLIBRARY=$<TARGET_FILE:hdlyap_core>)
  hdlyap_script_test(golden_levels)
endif()

# What is executed, line by line: the core compiled once more, so that no line is another one's, in a program
# for callgrind.
if(NOT HDLYAP_SANITIZE)
  find_program(HDLYAP_VALGRIND valgrind)
  get_target_property(sources hdlyap_core SOURCES)
  list(TRANSFORM sources PREPEND ${HDLYAP_CORE_FOLDER}/)
  add_executable(hdlyap_load load.c ${sources})
  target_include_directories(hdlyap_load PRIVATE ${HDLYAP_CORE_FOLDER}/include)
  target_include_directories(hdlyap_load SYSTEM PRIVATE ${OPENBLAS_INCLUDE_DIRS} ${LAPACKE_INCLUDE_DIRS})
  target_link_libraries(hdlyap_load PRIVATE ${HDLYAP_CORE_LIBRARIES})
  set_target_properties(hdlyap_load PROPERTIES C_STANDARD 11 C_EXTENSIONS OFF)
  target_compile_options(hdlyap_load PRIVATE ${HDLYAP_C_WARNINGS} ${HDLYAP_C_EXACT} -O1 -g1 -fno-inline)
  add_test(NAME core_instructions COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/instructions.py
    ${HDLYAP_VALGRIND} $<TARGET_FILE:hdlyap_load> ${HDLYAP_CORE_FOLDER})
endif()
