# A scene for POV-Ray: awk -f povray.awk VIEW OBJ, the view as flags of facemap render. Its world is left-handed:
# the picture is turned by the camera's right vector, the numbers stay.
FNR == NR {
  for (i = 1; i < NF; ++i) {
    if ($i == "--camera") camera = $(i + 1)
    if ($i == "--look-at") look_at = $(i + 1)
    if ($i == "--field-angle") angle = $(i + 1)
    if ($i == "--light") {
      split($(i + 1), light, ",")
      printf "light_source { <%s,%s,%s> rgb <%s,%s,%s> }\n", light[1], light[2], light[3], light[4], light[5], light[6]
    }
  }
  printf "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n"
  printf "camera { location <%s> right -x up y angle %s look_at <%s> }\n", camera, angle, look_at
  next
}
$1 == "v" { vertices[++vertex_count] = "<" $2 "," $3 "," $4 ">" }
$1 == "f" {
  for (k = 3; k < NF; ++k) faces[++face_count] = "<" $2 - 1 "," $k - 1 "," $(k + 1) - 1 ">"
}
END {
  printf "mesh2 {\nvertex_vectors { %d", vertex_count
  for (i = 1; i <= vertex_count; ++i) printf ",\n%s", vertices[i]
  printf " }\nface_indices { %d", face_count
  for (i = 1; i <= face_count; ++i) printf ",\n%s", faces[i]
  printf " }\npigment { rgb 1 } finish { ambient 0 diffuse 1 }\n}\n"
}
