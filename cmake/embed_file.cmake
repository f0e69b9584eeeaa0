# Writes INPUT as the string SYMBOL into the source file OUTPUT (run by pintle_embed).
file(READ "${INPUT}" text)
file(WRITE "${OUTPUT}" "namespace pintle {
extern const char* const ${SYMBOL};
const char* const ${SYMBOL} = R\"pintle_text(${text})pintle_text\";
}  // namespace pintle
")
