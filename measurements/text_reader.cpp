#include "measurements/text_reader.hpp"
