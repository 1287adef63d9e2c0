# palpa_module(NAME [PUBLIC libs...] [PRIVATE libs...])
# One folder, one static library named palpa_NAME. Includes start at the top of the tree
# ("haptics/tick.h"). PUBLIC libraries may appear in the folder's headers, PRIVATE ones only in its
# sources: that is how the build refuses an arrow that runs the wrong way.
function(palpa_module NAME)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(sources)
    add_library(palpa_${NAME} STATIC ${sources})
    target_include_directories(palpa_${NAME} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(palpa_${NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  else()
    add_library(palpa_${NAME} INTERFACE)
    target_include_directories(palpa_${NAME} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(palpa_${NAME} INTERFACE ${ARG_PUBLIC})
  endif()
endfunction()

# palpa_linked_only(NAME): under AddressSanitizer and UndefinedBehaviorSanitizer this module is only linked, not looked into, unless
# PALPA_SANITIZE_WHOLE (./check --full): compiling its templates takes ten minutes there.
function(palpa_linked_only NAME)
  if(PALPA_SANITIZE MATCHES "address" AND NOT PALPA_SANITIZE_WHOLE)
    target_compile_options(palpa_${NAME} PRIVATE -fno-sanitize=all -g0)
  endif()
endfunction()
