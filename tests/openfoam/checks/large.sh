# A mesh of a million cells (only with --full).

changed large
controls 'endTime 0.15; writeInterval 3; writeFormat binary;'
mesh_is '2000 500 1'
logged msddFoam
check "10^6 cells: three steps" grep -q '"steps": 3,' postProcessing/msddFoam/summary.json
rm -rf "$work/large"
