# Bad input. Each file of bad/ is appended to constant/granularProperties of a good case, or to the file that its second
# line names; its first line says what must be answered, with the file's name.

bad_dictionaries() {
    local file wanted target
    changed bad
    mesh_is '12 6 1'
    echo '{"schema": "msdd-state-model-1", ' > system/damaged.json
    for file in "$here"/bad/*; do
        wanted=$(sed -n '1s,^// expect: ,,p' "$file")
        target=$(sed -n '2s,^// file: ,,p' "$file")
        : "${target:=constant/granularProperties}"
        cp "$target" good
        cat good "$file" > "$target"
        answered() { refused "$wanted" && grep -q "$target" log.bad; }
        check "refused: ${file##*/}" answered
        cp good "$target"
    done
}

bad_fields() {
    local name
    rm -rf good.0
    cp -r 0 good.0
    bad_field() { # name of the check, field, message, sed expression
        local message=$3 where=0/$2
        sed -i "$4" "$where"
        answered() { refused "$message" && grep -q "$where" log.bad; }
        check "refused: $1" answered
        cp good.0/* 0/
    }
    bad_field "porosity in percent" porosity 'allowed: between 0 and 1' 's/^#include.*common.porosity.*/&\ninternalField uniform 12.5;/'
    bad_field "porosity in metres" porosity 'has dimensions [0 1 0 0 0 0 0], allowed: [0 0 0 0 0 0 0]' \
        's/^#include.*common.porosity.*/&\ndimensions [0 1 0 0 0 0 0];/'
    bad_field "T in metres" T 'has dimensions [0 1 0 0 0 0 0], allowed: [0 0 0 1 0 0 0]' 's/^dimensions.*/dimensions [0 1 0 0 0 0 0];/'
    bad_field "T is no number" T 'FOAM FATAL' 's/^internalField.*/internalField uniform nan;/'
    for name in T porosity fabricIndex; do
        rm "0/$name"
        answered() { refused "FATAL" && grep -q "0/$name" log.bad; }
        check "refused: field $name missing" answered
        cp good.0/* 0/
    done
}

three_dimensional() {
    changed bad-3d
    cat >> system/blockMeshDict <<-'END'
	boundary
	(
	    left { type wall; faces ((0 4 7 3)); }
	    right { type wall; faces ((1 2 6 5)); }
	    bottom { type wall; faces ((0 1 5 4)); }
	    top { type wall; faces ((3 7 6 2)); }
	    front { type wall; faces ((0 3 2 1)); }
	    back { type wall; faces ((4 5 6 7)); }
	);
	END
    mesh_is '3 2 2'
    check "refused: three-dimensional mesh" refused 'is three-dimensional, allowed: two-dimensional in x and y'
}

bad_dictionaries
bad_fields
three_dimensional
