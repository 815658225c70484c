# Another user before the mirror: takes whatever it can of the folders that it is given and of iceoryx2's memory, for
# some seconds, and says what it got hold of.
exec 2>&-
held() { echo "$1 $2"; }
end=$(($(date +%s) + 3))
while [ "$(date +%s)" -lt "$end" ]; do
    for path in $(find "$@" /dev/shm/iox2_*); do
        if [ -f "$path" ]; then
            true < "$path" && held read "$path"
            true >> "$path" && held write "$path"
        else
            true > "$path/made" && held make "$path" && rm -f "$path/made"
        fi
        truncate -c -s 0 "$path" && held truncate "$path"
        chmod 777 "$path" && held open "$path"
        mv "$path" "$path.moved" && held move "$path"
        ln -sfT /etc/passwd "$path" && held link "$path"
        rm -r "$path" && held remove "$path"
    done
done
echo done
