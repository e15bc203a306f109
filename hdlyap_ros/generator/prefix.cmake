# catkin of Debian 13 names the prefix in the files of pkg-config by a variable that nobody sets.
function(hdlyap_name_prefix file prefix)
  file(READ "${file}" text)
  string(REPLACE "\${hdlyap_PREFIX}" "${prefix}" text "${text}")
  file(WRITE "${file}" "${text}")
endfunction()

hdlyap_name_prefix("${CATKIN_DEVEL_PREFIX}/lib/pkgconfig/hdlyap.pc" "${CATKIN_DEVEL_PREFIX}")
hdlyap_name_prefix("${CMAKE_CURRENT_BINARY_DIR}/catkin_generated/installspace/hdlyap.pc" "${CMAKE_INSTALL_PREFIX}")
