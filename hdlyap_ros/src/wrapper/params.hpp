/** Values of parameters; private to the wrapper. */
#pragma once

#include <string>

#include <XmlRpcValue.h>

/** Of a string its contents, of a list as YAML has it. Equal values have one text, however they
 * were written. */
std::string param_text(XmlRpc::XmlRpcValue &value);
