/* A controller written in Python. [controller.config] names a module, in the folder `path`, with
 *
 * - create(setup): setup a dict of sample_time, clearance, config, ...; what it returns is the law;
 * - state_size(law): numbers of its state; may be absent, then 0;
 * - step(law, now, state): now a dict of the measurement, state a memoryview of floats, to be
 *   changed in place; returns (ux, uy), N, the force on the ring.
 *
 * An exception ends the run with its words and where it was raised. Every step takes the
 * interpreter's lock: it is right on several threads, and no faster than on one.
 *
 *   cc -shared -fPIC -I $ROTORUB/native_model/control/abi $(pkg-config --cflags python3-embed) \
 *     python_controller.c -o python_controller.so $(pkg-config --libs python3-embed) */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include <rotorub/controller.h>

typedef struct {
  PyObject *step, *law;
  Py_ssize_t size;
} law;

/* One of a traceback's frames as ", FUNCTION (FILE:LINE)" behind the reason. */
static void add_frame(PyObject* trace, char* reason, size_t room) {
  PyObject *frame = PyObject_GetAttrString(trace, "tb_frame"),
           *line = PyObject_GetAttrString(trace, "tb_lineno"),
           *code = frame != NULL ? PyObject_GetAttrString(frame, "f_code") : NULL,
           *file = code != NULL ? PyObject_GetAttrString(code, "co_filename") : NULL,
           *name = code != NULL ? PyObject_GetAttrString(code, "co_name") : NULL;
  if (line != NULL && file != NULL && name != NULL) {
    const size_t used = strlen(reason);
    PyObject* text = PyUnicode_FromFormat(", in %U (%U:%S)", name, file, line);
    const char* words = text != NULL ? PyUnicode_AsUTF8(text) : NULL;
    if (words != NULL) snprintf(reason + used, room - used, "%s", words);
    Py_XDECREF(text);
  }
  Py_XDECREF(name);
  Py_XDECREF(file);
  Py_XDECREF(code);
  Py_XDECREF(line);
  Py_XDECREF(frame);
}

/* The frames of a traceback, of a deep one the innermost. */
static void add_frames(PyObject* trace, char* reason, size_t room) {
  enum { MOST = 3 };
  PyObject* frames[MOST] = {NULL};
  size_t depth = 0;
  for (PyObject* at = trace; at != NULL && at != Py_None; ++depth) {
    Py_XDECREF(frames[depth % MOST]);
    Py_INCREF(at);
    frames[depth % MOST] = at;
    PyObject* next = PyObject_GetAttrString(at, "tb_next");
    Py_XDECREF(next); /* the frame before holds it */
    at = next;
  }
  for (size_t i = depth > MOST ? depth - MOST : 0; i < depth; ++i)
    add_frame(frames[i % MOST], reason, room);
  for (size_t i = 0; i < MOST; ++i) Py_XDECREF(frames[i]);
}

/* Behind a KeyError the keys of what the law is given, unless the one it asks for is there. */
static void add_keys(PyObject* type, PyObject* value, const char* name, PyObject* given,
                     char* reason, size_t room) {
  if (given == NULL || value == NULL || !PyErr_GivenExceptionMatches(type, PyExc_KeyError)) return;
  PyObject *arguments = PyObject_GetAttrString(value, "args"),
           *key = arguments != NULL ? PySequence_GetItem(arguments, 0) : NULL,
           *comma = PyUnicode_FromString(", "),
           *keys = comma != NULL ? PyUnicode_Join(comma, given) : NULL;
  if (keys != NULL && key != NULL && PyUnicode_Check(key) && PyDict_Contains(given, key) == 0) {
    const size_t used = strlen(reason);
    const char* words = PyUnicode_AsUTF8(keys);
    if (words != NULL) snprintf(reason + used, room - used, "; %s has the keys %s", name, words);
  }
  PyErr_Clear();
  Py_XDECREF(keys);
  Py_XDECREF(comma);
  Py_XDECREF(key);
  Py_XDECREF(arguments);
}

/* The pending exception in words, with the places in the user's files that it came through. given:
 * the dict that the law is called with as `name`, or NULL. */
static int failed(const char* name, PyObject* given, char* reason, size_t room) {
  PyObject *type, *value, *trace;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  PyObject* text = value != NULL ? PyObject_Str(value) : NULL;
  const char* words = text != NULL ? PyUnicode_AsUTF8(text) : NULL;
  snprintf(reason, room, "%s: %s", type != NULL ? ((PyTypeObject*)type)->tp_name : "Python",
           words != NULL ? words : "it failed");
  add_frames(trace, reason, room);
  add_keys(type, value, name, given, reason, room);
  Py_XDECREF(text);
  Py_XDECREF(type);
  Py_XDECREF(value);
  Py_XDECREF(trace);
  PyErr_Clear();
  return 1;
}

static void start_python(void) {
  if (Py_IsInitialized()) return;
  /* Modules written in C look for Python's symbols in the program. */
  Dl_info info;
  if (dladdr(Py_None, &info) != 0) {
    dlopen(info.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  }
  Py_InitializeEx(0);
  PyEval_SaveThread();
}

static PyObject* config_of(const rotorub_setup* setup) {
  PyObject* config = PyDict_New();
  for (size_t i = 0; config != NULL && i < setup->entries; ++i) {
    const rotorub_entry* e = &setup->config[i];
    PyObject* value =
        e->text != NULL ? PyUnicode_FromString(e->text) : PyFloat_FromDouble(e->number);
    if (value == NULL || PyDict_SetItemString(config, e->key, value) != 0) Py_CLEAR(config);
    Py_XDECREF(value);
  }
  return config;
}

static const char* text_of(const rotorub_setup* setup, const char* key) {
  for (size_t i = 0; i < setup->entries; ++i) {
    if (strcmp(setup->config[i].key, key) == 0) return setup->config[i].text;
  }
  return NULL;
}

/* A function of the user's module; NULL, with an exception that names it: there is none. */
static PyObject* function_of(PyObject* module, const char* name, const char* arguments) {
  PyObject* function = PyObject_GetAttrString(module, name);
  if (function != NULL && PyCallable_Check(function)) return function;
  Py_XDECREF(function);
  PyErr_Clear();
  PyObject* file = PyModule_GetFilenameObject(module);
  if (file == NULL) PyErr_Clear();
  PyErr_Format(PyExc_AttributeError, "%V has no function %s(%s)", file, "the module", name,
               arguments);
  Py_XDECREF(file);
  return NULL;
}

/* told: what create() is called with, to be released by the caller. */
static int load(const rotorub_setup* setup, law* l, PyObject** told) {
  const char *path = text_of(setup, "path"), *name = text_of(setup, "module");
  if (name == NULL) {
    PyErr_SetString(PyExc_ValueError, "controller.config needs module = \"NAME\"");
    return 1;
  }
  PyObject* paths = PySys_GetObject("path");
  PyObject* folder = PyUnicode_FromString(path != NULL ? path : ".");
  if (paths == NULL || folder == NULL) return 1;
  const int known = PySequence_Contains(paths, folder);
  if (known < 0 || (known == 0 && PyList_Insert(paths, 0, folder) != 0)) return 1;
  Py_DECREF(folder);
  PyObject* module = PyImport_ImportModule(name);
  if (module == NULL) return 1;
  PyObject* config = config_of(setup);
  *told = Py_BuildValue("{s:d,s:d,s:I,s:(dd),s:(dd),s:(dd),s:O}", "sample_time", setup->sample_time,
                        "clearance", setup->clearance, "measured", setup->measured, "stator_mass",
                        setup->stator_mass[0], setup->stator_mass[1], "stator_damping",
                        setup->stator_damping[0], setup->stator_damping[1], "stator_stiffness",
                        setup->stator_stiffness[0], setup->stator_stiffness[1], "config", config);
  Py_XDECREF(config);
  PyObject* begin = *told != NULL ? function_of(module, "create", "setup") : NULL;
  if (begin != NULL) l->step = function_of(module, "step", "law, now, state");
  if (l->step != NULL) l->law = PyObject_CallFunctionObjArgs(begin, *told, NULL);
  Py_XDECREF(begin);
  if (l->law != NULL && PyObject_HasAttrString(module, "state_size")) {
    PyObject* size = PyObject_CallMethod(module, "state_size", "O", l->law);
    l->size = size != NULL ? PyNumber_AsSsize_t(size, PyExc_OverflowError) : -1;
    Py_XDECREF(size);
  }
  Py_DECREF(module);
  return l->law == NULL || l->size < 0;
}

static void destroy(void* self) {
  law* l = self;
  if (l == NULL) return;
  const PyGILState_STATE lock = PyGILState_Ensure();
  Py_XDECREF(l->step);
  Py_XDECREF(l->law);
  PyGILState_Release(lock);
  free(l);
}

static int create(const rotorub_setup* setup, void** self, char* reason, size_t room) {
  start_python();
  law* l = calloc(1, sizeof *l);
  if (l == NULL) return 1;
  const PyGILState_STATE lock = PyGILState_Ensure();
  PyObject* told = NULL;
  const int bad = load(setup, l, &told) != 0 ? failed("setup", told, reason, room) : 0;
  Py_XDECREF(told);
  PyGILState_Release(lock);
  if (bad) {
    destroy(l);
    return 1;
  }
  *self = l;
  return 0;
}

static size_t state_size(const void* self) { return (size_t)((const law*)self)->size; }

/* A memoryview of doubles over the caller's array. */
static PyObject* view_of(double* state, Py_ssize_t size) {
  double none;
  PyObject* bytes = PyMemoryView_FromMemory((char*)(size > 0 ? state : &none),
                                            size * (Py_ssize_t)sizeof *state, PyBUF_WRITE);
  PyObject* view = bytes != NULL ? PyObject_CallMethod(bytes, "cast", "s", "d") : NULL;
  Py_XDECREF(bytes);
  return view;
}

static int step(const void* self, const rotorub_measurement* now, double* state, double command[2],
                char* reason, size_t room) {
  const law* l = self;
  const PyGILState_STATE lock = PyGILState_Ensure();
  PyObject* view = view_of(state, l->size);
  PyObject* shown = Py_BuildValue(
      "{s:d,s:L,s:(dd),s:(dd),s:(dd),s:(dd),s:d,s:d,s:(dd)}", "t", now->t, "sample",
      (long long)now->sample, "rotor", now->rotor[0], now->rotor[1], "rotor_velocity",
      now->rotor_velocity[0], now->rotor_velocity[1], "stator", now->stator[0], now->stator[1],
      "stator_velocity", now->stator_velocity[0], now->stator_velocity[1], "spin_angle",
      now->spin_angle, "spin_speed", now->spin_speed, "current", now->current[0], now->current[1]);
  PyObject* told = view != NULL && shown != NULL
                       ? PyObject_CallFunctionObjArgs(l->step, l->law, shown, view, NULL)
                       : NULL;
  if (told != NULL && !PyTuple_Check(told)) {
    PyErr_Format(PyExc_TypeError, "step() returns %.100s; return two numbers, ux and uy",
                 Py_TYPE(told)->tp_name);
    Py_CLEAR(told);
  } else if (told != NULL && PyTuple_Size(told) != 2) {
    PyErr_Format(PyExc_TypeError, "step() returns %zd numbers; return two, ux and uy",
                 PyTuple_Size(told));
    Py_CLEAR(told);
  }
  const int good = told != NULL && PyArg_ParseTuple(told, "dd", &command[0], &command[1]);
  const int bad = good ? 0 : failed("now", shown, reason, room);
  Py_XDECREF(told);
  Py_XDECREF(shown);
  /* Whoever kept the view must not write to the array later. */
  if (view != NULL) {
    PyObject* released = PyObject_CallMethod(view, "release", NULL);
    if (released == NULL) PyErr_Clear();
    Py_XDECREF(released);
    Py_DECREF(view);
  }
  PyGILState_Release(lock);
  return bad;
}

const rotorub_controller* rotorub_controller_get(void) {
  static const rotorub_controller controller = {ROTORUB_CONTROLLER_ABI,
                                                ROTORUB_FORCE,
                                                "python_controller",
                                                create,
                                                destroy,
                                                state_size,
                                                NULL,
                                                step};
  return &controller;
}
