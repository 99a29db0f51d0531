# Orders of both schemes in time.

check "orders in time" "$here/order" $([ $full = no ] || echo --full)
