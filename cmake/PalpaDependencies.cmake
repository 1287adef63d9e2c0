# Every library comes from a Debian package; `run` and `check` install them.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json 3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(ZLIB REQUIRED)
find_package(OpenSSL REQUIRED)  # SHA-256, random bytes, Base64, encrypted lines
find_package(Boost 1.70 REQUIRED)  # headers only: Boost.Math, Boost.UUID
find_package(apriltag REQUIRED)
find_package(OpenCV 4 REQUIRED COMPONENTS core imgproc imgcodecs calib3d videoio)
# ArUco: a module of its own before OpenCV 4.7, part of another since.
if(OpenCV_VERSION VERSION_LESS 4.7)
  set(aruco_module aruco)
else()
  set(aruco_module objdetect)
endif()
find_package(OpenCV 4 REQUIRED COMPONENTS core ${aruco_module})
add_library(OpenCV::ArUco INTERFACE IMPORTED)
target_link_libraries(OpenCV::ArUco INTERFACE opencv_${aruco_module})
find_package(OpenXR 1.0 REQUIRED)
find_package(glm REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(SQLITE3 REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(PQXX REQUIRED IMPORTED_TARGET libpqxx)
pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)
pkg_check_modules(MOSQUITTO REQUIRED IMPORTED_TARGET libmosquitto)
pkg_check_modules(AVAHI REQUIRED avahi-client)
pkg_check_modules(CJOSE REQUIRED IMPORTED_TARGET cjose)
# Without its _REENTRANT, which would refuse the headers that are compiled once.
add_library(Avahi::Client INTERFACE IMPORTED)
target_link_libraries(Avahi::Client INTERFACE ${AVAHI_LINK_LIBRARIES})
pkg_check_modules(OPENAL REQUIRED IMPORTED_TARGET openal)
pkg_check_modules(LIBUSB REQUIRED IMPORTED_TARGET libusb-1.0)
# OpenIGTLink: its package's own file is refused by CMake of today.
find_path(IGTL_HEADERS igtlTransformMessage.h PATH_SUFFIXES openigtlink REQUIRED)
find_library(IGTL_LIBRARY OpenIGTLink REQUIRED)
add_library(OpenIGTLink::OpenIGTLink INTERFACE IMPORTED)
# Imported: warnings in its headers are not ours.
target_include_directories(OpenIGTLink::OpenIGTLink INTERFACE ${IGTL_HEADERS})
target_link_libraries(OpenIGTLink::OpenIGTLink INTERFACE ${IGTL_LIBRARY})
find_package(VTK 9 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonMath CommonTransforms CommonExecutionModel
  FiltersCore FiltersGeneral FiltersSources FiltersModeling
  ImagingCore IOGeometry IOImage InteractionStyle
  RenderingCore RenderingOpenGL2 RenderingFreeType RenderingAnnotation RenderingUI glew)
# Only compared with, in `palpa bench anatomy`. Embree 4 (Debian 13) is another interface: left out.
find_package(embree 3 QUIET)
