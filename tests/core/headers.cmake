# cmake -DCORE=<hdlyap_core> -DWORK=<folder> [-DLIBRARY=<libhdlyap_core.so> -DLIBRARY_3D=<libhdlyap_core_3d.so>] -P headers.cmake
# Each public header alone, as strict C and as C++; with the libraries, a C++ program that uses each.
cmake_minimum_required(VERSION 3.16)

set(WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
file(GLOB HEADERS RELATIVE ${CORE}/include ${CORE}/include/hdlyap/*.h)
if(NOT HEADERS)
  message(FATAL_ERROR "no headers below ${CORE}")
endif()
file(MAKE_DIRECTORY ${WORK})

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed ERROR_VARIABLE text)
  if(failed)
    message(SEND_ERROR "${what}:\n${text}")
  endif()
endfunction()

# Included twice, as the first and only line: what a header needs it must include itself.
function(check_headers compiler suffix)
  foreach(header IN LISTS HEADERS)
    get_filename_component(name ${header} NAME_WE)
    set(source ${WORK}/alone_${name}.${suffix})
    file(WRITE ${source} "#include \"${header}\"\n#include \"${header}\"\nint main(void);\n")
    foreach(standard IN LISTS ARGN)
      foreach(spheres "" -DHD_DIM=3)
        run("${compiler} -std=${standard} ${spheres} ${header}" ${compiler} -std=${standard} ${spheres} ${WARNINGS}
          -I${CORE}/include -fsyntax-only ${source})
      endforeach()
    endforeach()
  endforeach()
  message("${compiler}: ${HEADERS} as ${ARGN}")
endfunction()

function(check_program compiler library) # .. and flags
  get_filename_component(folder ${library} DIRECTORY)
  get_filename_component(name ${compiler} NAME)
  get_filename_component(linked ${library} NAME_WE)
  set(program ${WORK}/uses_${linked}_${name})
  run("${compiler} with ${linked}" ${compiler} -std=c++11 ${ARGN} ${WARNINGS} -I${CORE}/include
    ${CMAKE_CURRENT_LIST_DIR}/headers.cpp -o ${program} ${library} -Wl,-rpath,${folder})
  run("${program}" ${program})
endfunction()

# Headers of one dimension and the library of the other do not link, and the linker names why.
function(check_mismatch compiler library) # .. and flags
  execute_process(COMMAND ${compiler} -std=c++11 ${ARGN} -I${CORE}/include ${CMAKE_CURRENT_LIST_DIR}/headers.cpp
    -o ${WORK}/mismatch ${library} RESULT_VARIABLE failed ERROR_VARIABLE text)
  if(NOT failed OR NOT text MATCHES "hd_scene_def_default")
    message(SEND_ERROR "${compiler} ${ARGN} with ${library}: must not link, and name hd_scene_def_default\n${text}")
  endif()
endfunction()

foreach(name gcc clang)
  find_program(HEADERS_${name} ${name})
  if(HEADERS_${name})
    check_headers(${HEADERS_${name}} c c11 c17)
    set(FOUND 1)
  endif()
endforeach()
foreach(name g++ clang++)
  find_program(HEADERS_${name} ${name})
  if(HEADERS_${name})
    check_headers(${HEADERS_${name}} cpp c++11 c++17)
    if(LIBRARY)
      check_program(${HEADERS_${name}} ${LIBRARY})
      check_program(${HEADERS_${name}} ${LIBRARY_3D} -DHD_DIM=3)
      check_mismatch(${HEADERS_${name}} ${LIBRARY_3D})
      check_mismatch(${HEADERS_${name}} ${LIBRARY} -DHD_DIM=3)
    endif()
  endif()
endforeach()
if(NOT FOUND)
  message(FATAL_ERROR "neither gcc nor clang was found")
endif()
