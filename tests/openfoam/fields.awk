# Prints the internal field of an OpenFOAM field file (ascii): one line a cell, components apart by blanks; one line for
# a uniform field.
/^internalField +uniform/ { gsub(/[();]/, " "); $1 = $2 = ""; print; exit }
/^internalField +nonuniform/ { wait = 1; next }
wait && /^\($/ { wait = 0; list = 1; next }
list && /^\)/ { exit }
list { gsub(/[()]/, ""); print }
