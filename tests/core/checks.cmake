# What the trajectory's tests need beside cmocka: the twin, the golden scenes, and checks of the sources.
foreach(name trajectory_twin trajectory_ties)
  target_sources(test_${name} PRIVATE twin.c twin_compare.c)
endforeach()
target_sources(test_golden PRIVATE golden.c)

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
