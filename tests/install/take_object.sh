#!/bin/sh
# A compiler launcher that copies the object of another build of the same sources, POUNDING_OBJECTS, instead of
# compiling.
for word; do
  [ "$before" = -o ] && object=$word
  before=$word
done
if [ -f "$POUNDING_OBJECTS/$object" ]; then
  exec cp "$POUNDING_OBJECTS/$object" "$object"
fi
exec "$@"
