# Headers that nearly every source reads are read once (precompiled): most sources spend more time
# on reading Eigen, JSON and the standard library than on what is theirs. cmake/README.md has the
# figures. Nothing may rest on it: each source still includes what it uses.
option(PALPA_PRECOMPILE "Read common headers once" ON)

set(common_headers
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map>
  <memory> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <utility>
  <variant> <vector> <Eigen/Core> <Eigen/Geometry> <nlohmann/json.hpp>)

# palpa_precompiled(TARGET HEADERS): a target that only holds these headers.
function(palpa_precompiled TARGET)
  file(WRITE ${PROJECT_BINARY_DIR}/${TARGET}.cpp "")
  add_library(${TARGET} OBJECT ${PROJECT_BINARY_DIR}/${TARGET}.cpp)
  target_precompile_headers(${TARGET} PRIVATE ${ARGN})
endfunction()

if(PALPA_PRECOMPILE)
  palpa_precompiled(palpa_headers ${common_headers})
  target_link_libraries(palpa_headers PRIVATE Eigen3::Eigen nlohmann_json::nlohmann_json)
endif()

# palpa_reads_common_headers(TARGET)
function(palpa_reads_common_headers TARGET)
  if(PALPA_PRECOMPILE)
    target_precompile_headers(${TARGET} REUSE_FROM palpa_headers)
  endif()
endfunction()
