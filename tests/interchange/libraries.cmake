find_package(VTK 9 REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel IOGeometry IOPLY)
list(APPEND libraries ${VTK_LIBRARIES})
