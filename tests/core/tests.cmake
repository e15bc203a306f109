foreach(name)
  hdlyap_core_test(${name})
endforeach()
