# palpa_module(NAME [ROOMS folders...] [PUBLIC libs...] [PRIVATE libs...])
# One folder with the rooms named, one static library named palpa_NAME. Includes start at the top of
# the tree ("haptics/loop/tick.h"). PUBLIC libraries may appear in the folder's headers, PRIVATE
# ones only in its sources: that is how the build refuses what docs/architecture.md does not allow.
function(palpa_module NAME)
  cmake_parse_arguments(ARG "" "" "ROOMS;PUBLIC;PRIVATE" ${ARGN})
  list(TRANSFORM ARG_ROOMS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE folders)
  list(TRANSFORM folders APPEND /*.cpp)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${folders})
  if(sources AND PALPA_PREBUILT AND NOT NAME IN_LIST PALPA_SANITIZED)
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/linked_only.cpp "")
    add_library(palpa_${NAME} STATIC ${CMAKE_CURRENT_BINARY_DIR}/linked_only.cpp)
    target_include_directories(palpa_${NAME} PUBLIC ${PROJECT_SOURCE_DIR})
    palpa_linked_only(${NAME})
    target_link_libraries(palpa_${NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  elseif(sources)
    add_library(palpa_${NAME} STATIC ${sources})
    target_include_directories(palpa_${NAME} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(palpa_${NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
    palpa_reads_common_headers(palpa_${NAME})
  else()
    add_library(palpa_${NAME} INTERFACE)
    target_include_directories(palpa_${NAME} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(palpa_${NAME} INTERFACE ${ARG_PUBLIC})
  endif()
endfunction()

# palpa_linked_only(NAME): the module is not compiled, but linked from PALPA_PREBUILT. Or only these
# sources of it: palpa_linked_only(NAME SOURCE...).
function(palpa_linked_only NAME)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(palpa_${NAME} PUBLIC ${PALPA_PREBUILT}/${folder}/libpalpa_${NAME}.a)
  set_source_files_properties(${ARGN} PROPERTIES HEADER_FILE_ONLY ON)
endfunction()
