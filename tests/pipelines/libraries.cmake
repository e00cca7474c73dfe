find_package(PNG REQUIRED)
list(APPEND libraries PNG::PNG)
