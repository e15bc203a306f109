# Mends the files of pkg-config that catkin writes. On Debian 13 the prefix in them is a variable that nobody sets, and on
# no system do they allow blanks in names of folders.
function(hdlyap_mend_pkg_config file prefix)
  file(READ "${file}" text)
  string(REPLACE "\${hdlyap_PREFIX}" "${prefix}" text "${text}")
  string(REGEX REPLACE " -([IL])(([^ \n]| [^-\n])+)" " -\\1\"\\2\"" text "${text}")
  file(WRITE "${file}" "${text}")
endfunction()

hdlyap_mend_pkg_config("${CATKIN_DEVEL_PREFIX}/lib/pkgconfig/hdlyap.pc" "${CATKIN_DEVEL_PREFIX}")
hdlyap_mend_pkg_config("${CMAKE_CURRENT_BINARY_DIR}/catkin_generated/installspace/hdlyap.pc" "${CMAKE_INSTALL_PREFIX}")
