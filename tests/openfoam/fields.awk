# Prints the internal field of an OpenFOAM field file (ascii): one line a cell, components apart by blanks; one line for
# a uniform field.
/^internalField +uniform/ { gsub(/[();]/, " "); $1 = $2 = ""; print; exit }
/^internalField +nonuniform.*;$/ { # a short list, on one line
    sub(/^[^(]*\(/, ""); sub(/\);$/, "")
    n = /\(/ ? split($0, cells, /\) *\(/) : split($0, cells, / +/)
    for (i = 1; i <= n; i++) { gsub(/[()]/, "", cells[i]); print cells[i] }
    exit
}
/^internalField +nonuniform/ { wait = 1; next }
wait && /^\($/ { wait = 0; list = 1; next }
list && /^\)/ { exit }
list { gsub(/[()]/, ""); print }
