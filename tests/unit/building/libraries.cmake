find_package(PNG REQUIRED)
list(APPEND libraries atrium_floorplan nlohmann_json::nlohmann_json PNG::PNG)
