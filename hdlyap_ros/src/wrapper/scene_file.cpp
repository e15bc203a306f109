/** YAML -> XML-RPC values. */
#include "scene_file.hpp"

#include <yaml.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <regex>
#include <stdexcept>

using XmlRpc::XmlRpcValue;

namespace
{
/** The tree of a file's first document. */
class document
{
  public:
    explicit document(const std::string &path) : path_(path)
    {
        yaml_parser_t parser;
        const std::unique_ptr<FILE, int (*)(FILE *)> file(std::fopen(path.c_str(), "re"), fclose);
        if (!file) fail("there is no such file, or it cannot be read");
        if (!yaml_parser_initialize(&parser)) throw std::bad_alloc();
        yaml_parser_set_input_file(&parser, file.get());
        const bool loaded = yaml_parser_load(&parser, &tree_) != 0;
        const std::string problem = loaded || !parser.problem ? "" : parser.problem;
        const size_t line = parser.problem_mark.line + 1;
        yaml_parser_delete(&parser);
        if (!loaded) fail("line " + std::to_string(line) + ": " + problem);
    }
    ~document() { yaml_document_delete(&tree_); }
    document(const document &) = delete;
    document &operator=(const document &) = delete;

    [[noreturn]] void fail(const std::string &what) const
    {
        throw std::runtime_error(path_ + ": " + what);
    }
    yaml_node_t *root() { return yaml_document_get_root_node(&tree_); }
    yaml_node_t *node(int number) { return yaml_document_get_node(&tree_, number); }

  private:
    std::string path_;
    yaml_document_t tree_;
};

std::string text_of(const yaml_node_t &node)
{
    return {reinterpret_cast<const char *>(node.data.scalar.value), node.data.scalar.length};
}

bool matches(const std::string &text, const char *pattern)
{
    return std::regex_match(text, std::regex(pattern));
}

XmlRpcValue scalar_of(const document &doc, const yaml_node_t *node)
{
    if (node->type != YAML_SCALAR_NODE)
        doc.fail("line " + std::to_string(node->start_mark.line + 1) +
                 ": a parameter is a number, a word or a list of these");
    const std::string text = text_of(*node);
    return node->data.scalar.style == YAML_PLAIN_SCALAR_STYLE ? scene_file_scalar(text)
                                                              : XmlRpcValue(text);
}

XmlRpcValue value_of(document &doc, const yaml_node_t *node)
{
    XmlRpcValue list;
    if (node->type != YAML_SEQUENCE_NODE) return scalar_of(doc, node);
    list.setSize(0);
    const auto &items = node->data.sequence.items;
    for (const yaml_node_item_t *item = items.start; item < items.top; item++) {
        const int k = list.size();
        list[k] = scalar_of(doc, doc.node(*item));
    }
    return list;
}
} // namespace

XmlRpcValue scene_file_scalar(const std::string &text)
{
    if (matches(text, "yes|Yes|YES|true|True|TRUE|on|On|ON")) return XmlRpcValue(true);
    if (matches(text, "no|No|NO|false|False|FALSE|off|Off|OFF")) return XmlRpcValue(false);
    if (matches(text, "[-+]?(0|[1-9][0-9]*)")) {
        const long long number = std::strtoll(text.c_str(), nullptr, 10);
        using limits = std::numeric_limits<int>;
        if (number >= limits::min() && number <= limits::max())
            return XmlRpcValue(static_cast<int>(number));
    }
    if (matches(text, "[-+]?([0-9]+\\.[0-9]*|\\.[0-9]+)([eE][-+][0-9]+)?"))
        return XmlRpcValue(std::strtod(text.c_str(), nullptr));
    return XmlRpcValue(text);
}

XmlRpcValue scene_file_read(const std::string &path)
{
    document doc(path);
    XmlRpcValue all;
    all.begin(); /* a struct, also without members */
    yaml_node_t *root = doc.root();
    if (!root) return all;
    if (root->type != YAML_MAPPING_NODE) doc.fail("must be a list of parameters, name: value");
    const auto &pairs = root->data.mapping.pairs;
    for (const yaml_node_pair_t *pair = pairs.start; pair < pairs.top; pair++) {
        const yaml_node_t *name = doc.node(pair->key);
        if (name->type != YAML_SCALAR_NODE) doc.fail("a name of a parameter is a word");
        all[text_of(*name)] = value_of(doc, doc.node(pair->value));
    }
    return all;
}
