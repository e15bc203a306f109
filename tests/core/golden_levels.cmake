# cmake -DCORE=<hdlyap_core> -DWORK=<folder> -P golden_levels.cmake
# Compiles the trajectory's sources with each compiler that is there, at each level of optimisation, and
# expects the same events of every program.
cmake_minimum_required(VERSION 3.16)

file(GLOB SOURCES ${CORE}/src/base/*.c ${CORE}/src/scene/*.c ${CORE}/src/dynamics/*.c ${CORE}/src/dynamics/hard/*.c)
list(FILTER SOURCES EXCLUDE REGEX "/(blas|gas)\\.c$") # which no event knows of
set(SOURCES_2 ${SOURCES}) # of disks
list(FILTER SOURCES_2 EXCLUDE REGEX "_3d\\.c$")
set(SOURCES_3 ${SOURCES}) # of spheres
list(FILTER SOURCES_3 EXCLUDE REGEX "_2d\\.c$")
set(TESTS ${CMAKE_CURRENT_LIST_DIR}/support)
set(EXACT -std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math)
# all that this processor can do; clang takes -mcpu=native for it on arm64, not -march
cmake_host_system_information(RESULT machine QUERY OS_PLATFORM)
if(machine MATCHES "^(aarch64|arm)")
  set(NATIVE -mcpu=native)
else()
  set(NATIVE -march=native)
endif()
set(LEVELS "-O0" "-O2" "-O3 ${NATIVE}")
file(MAKE_DIRECTORY ${WORK})

function(expect_golden compiler level dimensions)
  string(REPLACE " " ";" flags ${level})
  get_filename_component(name ${compiler} NAME)
  string(MAKE_C_IDENTIFIER "golden_${name}${level}_${dimensions}d" program)
  execute_process(RESULT_VARIABLE failed
    COMMAND ${compiler} ${EXACT} ${flags} -DHD_DIM=${dimensions} -I${CORE}/include -I${CORE}/src -I${TESTS}
      ${SOURCES_${dimensions}}
      ${TESTS}/golden.c ${TESTS}/golden_main.c -o ${WORK}/${program} -lz -lm)
  if(failed)
    message(FATAL_ERROR "${compiler} ${level}, ${dimensions} dimensions: does not compile")
  endif()
  execute_process(COMMAND ${WORK}/${program} RESULT_VARIABLE failed OUTPUT_VARIABLE hashes)
  if(failed)
    message(FATAL_ERROR "${compiler} ${level}, ${dimensions} dimensions:\n${hashes}")
  endif()
  message("${compiler} ${level}, ${dimensions} dimensions: as stored")
endfunction()

set(COMPILERS "")
foreach(name gcc clang)
  find_program(GOLDEN_${name} ${name})
  if(GOLDEN_${name})
    list(APPEND COMPILERS ${GOLDEN_${name}})
  endif()
endforeach()
if(NOT COMPILERS)
  message(FATAL_ERROR "neither gcc nor clang was found")
endif()
foreach(compiler IN LISTS COMPILERS)
  foreach(level IN LISTS LEVELS)
    expect_golden(${compiler} ${level} 2)
    expect_golden(${compiler} ${level} 3)
  endforeach()
endforeach()
