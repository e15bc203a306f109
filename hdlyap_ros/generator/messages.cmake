# msg/*.msg -> the header of the C structs, beside the headers that gencpp makes, and the lists of fields
# for the wrapper.
file(GLOB HDLYAP_MESSAGES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/msg/*.msg)
set(HDLYAP_GENERATOR ${CMAKE_CURRENT_LIST_DIR}/generate.py)
set(HDLYAP_MADE_INCLUDE ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION})
set(HDLYAP_MADE_FIELDS ${PROJECT_BINARY_DIR}/hdlyap_ros/wrapper)
set(HDLYAP_MADE ${HDLYAP_MADE_INCLUDE}/hdlyap_ros/messages.h ${HDLYAP_MADE_FIELDS}/message_fields.hpp)
add_custom_command(OUTPUT ${HDLYAP_MADE}
  COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE} ${HDLYAP_GENERATOR} ${PROJECT_NAME} ${HDLYAP_MADE} ${HDLYAP_MESSAGES}
  DEPENDS ${HDLYAP_GENERATOR} ${CMAKE_CURRENT_LIST_DIR}/../python/hdlyap/data/fields.py ${HDLYAP_MESSAGES}
  COMMENT "Making the messages for C"
  VERBATIM
)
add_custom_target(${PROJECT_NAME}_generate_messages_c ALL DEPENDS ${HDLYAP_MADE})
list(APPEND ${PROJECT_NAME}_EXPORTED_TARGETS ${PROJECT_NAME}_generate_messages_c)
